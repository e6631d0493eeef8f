// SPDX-License-Identifier: GPL-3.0-or-later
//
// Feeds the narrow phase: a bare traversal of two trees, stopped and resumed, or a Bullet world of trees and whatever
// they can meet.
#include "bare_traversal.h"
#include "world_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cairn::fuzz::Bytes bytes({data, size});
  if (bytes.next() % 2 == 0)
    cairn::fuzz::checkBareTraversal(bytes);
  else
    cairn::fuzz::checkWorld(bytes);
  return 0;
}
