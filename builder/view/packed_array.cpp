// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/packed_array.h"

#include <openssl/evp.h>

#include <algorithm>

namespace cairn::builder {
namespace {

// Bytes encoded at once: the library counts in int. A multiple of 3, so that only the last part is padded.
constexpr std::size_t kPart = 3U << 20U;

}  // namespace

std::string PackedArray::base64() const {
  std::string text;
  std::vector<unsigned char> encoded(kPart / 3 * 4 + 1);  // with the zero the library ends its texts with
  for (std::size_t at = 0; at < bytes_.size(); at += kPart) {
    const auto size = static_cast<int>(std::min(kPart, bytes_.size() - at));
    const int length = EVP_EncodeBlock(encoded.data(), bytes_.data() + at, size);
    text.append(encoded.begin(), encoded.begin() + length);
  }
  return text;
}

}  // namespace cairn::builder
