// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/runs/seal.h"

#include <algorithm>
#include <span>
#include <utility>

#include "cairn/builder/sha256.h"
#include "cairn/core/atomic_file.h"

namespace cairn::accuracy_cost {
namespace {

using Json = nlohmann::ordered_json;
constexpr const char* kSeal = "sha256";

std::string sealOf(const Json& document) {
  const std::string text = document.dump();
  return builder::sha256Hex(std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace

Json digestsOf(const std::vector<std::string>& names, const std::filesystem::path& folder) {
  Json digests = Json::object();
  for (const std::string& name : names)
    if (const auto bytes = readFile(folder / name)) digests[name] = builder::sha256Hex(bytes.value());
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
