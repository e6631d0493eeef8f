// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/runs/seal.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "cairn/core/atomic_file.h"

namespace cairn::accuracy_cost {
namespace {

using Json = nlohmann::ordered_json;
constexpr const char* kSeal = "sha256";

std::string sha256Of(std::span<const std::byte> bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr);
  std::string text;
  for (unsigned i = 0; i < size; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

std::string sealOf(const Json& document) {
  const std::string text = document.dump();
  return sha256Of(std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace

Json digestsOf(const std::vector<std::string>& names, const std::filesystem::path& folder) {
  Json digests = Json::object();
  for (const std::string& name : names)
    if (const auto bytes = readFile(folder / name)) digests[name] = sha256Of(bytes.value());
  return digests;
}

bool areWhole(const std::vector<std::string>& names, const Json& digests, const std::filesystem::path& folder) {
  const Json now = digestsOf(names, folder);
  return digests.is_object() && std::ranges::all_of(names, [&](const std::string& name) {
           return now.contains(name) && digests.contains(name) && digests[name] == now[name];
         });
}

Json sealed(Json document) {
  document.erase(kSeal);
  std::string seal = sealOf(document);
  document[kSeal] = std::move(seal);
  return document;
}

bool isSealed(const Json& document) {
  if (!document.is_object() || !document.contains(kSeal)) return false;
  Json rest = document;
  rest.erase(kSeal);
  return document[kSeal] == sealOf(rest);
}

}  // namespace cairn::accuracy_cost
