// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <utility>

#include "cairn/builder/build.h"

namespace cairn::builder {

namespace {

constexpr std::array<std::pair<Method, const char*>, 5> kMethodNames{{{Method::combined, "combined"},
                                                                      {Method::merge, "merge"},
                                                                      {Method::expand, "expand"},
                                                                      {Method::octree, "octree"},
                                                                      {Method::adaptive, "adaptive"}}};

}  // namespace

Result<Method> parseMethod(const std::string& name) {
  std::string known;
  for (const auto& [method, methodText] : kMethodNames) {
    if (name == methodText) return method;
    known += (known.empty() ? "" : ", ") + std::string(methodText);
  }
  return Error{"there is no method '" + name + "'; choose one of " + known};
}

const char* methodName(Method method) {
  for (const auto& [known, name] : kMethodNames)
    if (known == method) return name;
  return "unknown";
}

}  // namespace cairn::builder
