// SPDX-License-Identifier: GPL-3.0-or-later
//
// Changes case files as JSON: values, keys, what is there and how often; now and then bytes.
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "rockfall/case/document.h"

namespace {

using cairn::rockfall::Json;
using Engine = std::mt19937_64;

template <class List>
auto& anyOf(List& list, Engine& engine) {
  return list[engine() % list.size()];
}

void collect(Json& value, std::vector<Json*>& all) {
  all.push_back(&value);
  if (value.is_structured())
    for (Json& child : value) collect(child, all);
}

Json anyValue(Engine& engine) {
  static const std::vector<Json> kValues{nullptr,
                                         true,
                                         0,
                                         1,
                                         2,
                                         -1,
                                         0.5,
                                         -0.0,
                                         1e-300,
                                         1e12,
                                         1e300,
                                         9007199254740992U,
                                         18446744073709551615U,
                                         -9223372036854775807,
                                         "",
                                         "stone",
                                         "soil",
                                         "plane",
                                         "channel",
                                         "stepped_slope",
                                         "talus_cone",
                                         "angular",
                                         "pfeiffer",
                                         "bourrier",
                                         "gully.asc",
                                         "no\nname",
                                         "~/",
                                         "gully.json",
                                         Json::array(),
                                         Json::object(),
                                         Json::array({0, 1}),
                                         Json::array({1, 0}),
                                         Json::array({Json::array({0, 0}), Json::array({1, 0}), Json::array({1, 1})})};
  return anyOf(kValues, engine);
}

std::string anyKey(Engine& engine) {
  static const std::vector<std::string> kKeys{"generated",
                                              "raster",
                                              "mesh",
                                              "make",
                                              "sizes",
                                              "stems",
                                              "polygon_m",
                                              "pairs",
                                              "default",
                                              "materials",
                                              "value",
                                              "zones",
                                              "cell_m",
                                              "geotiff",
                                              "raster_cell_m",
                                              "law",
                                              "half_speed_m_per_s",
                                              "default_half_speed_m_per_s",
                                              "velocity_m_per_s",
                                              "interval_s",
                                              "tree_depth",
                                              "variants",
                                              "concave",
                                              "gravity_m_per_s2",
                                              "budget",
                                              "operations",
                                              "microseconds",
                                              "collectors",
                                              "outputs",
                                              "level_cm",
                                              "a\nb",
                                              "/~"};
  return anyOf(kKeys, engine);
}

void changeNumber(Json& value, Engine& engine) {
  constexpr double kFactors[] = {-1, 0, 0.5, 2, 10, 1e-3, 1e6, 1.0000001};
  value = value.get<double>() * kFactors[engine() % std::size(kFactors)];
}

void changeMembers(Json& object, Engine& engine) {
  if (object.empty() || engine() % 4 == 0) {
    object[anyKey(engine)] = anyValue(engine);
    return;
  }
  auto member = object.begin();
  std::advance(member, std::ptrdiff_t(engine() % object.size()));
  if (engine() % 2 == 0) object[anyKey(engine)] = *member;
  object.erase(member);
}

void changeElements(Json& list, Engine& engine) {
  if (list.empty() || engine() % 4 == 0) return list.push_back(anyValue(engine));
  const std::size_t i = engine() % list.size();
  if (engine() % 2 == 0)
    list.push_back(Json(list[i]));
  else
    list.erase(i);
}

void changeOnce(Json& document, Engine& engine) {
  std::vector<Json*> all;
  collect(document, all);
  Json& value = *anyOf(all, engine);
  const std::uint64_t how = engine() % 8;
  if (how == 0) {
    const Json other = *anyOf(all, engine);
    value = other;
  } else if (how == 1) {
    value = anyValue(engine);
  } else if (value.is_object()) {
    changeMembers(value, engine);
  } else if (value.is_array()) {
    changeElements(value, engine);
  } else if (value.is_number()) {
    changeNumber(value, engine);
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maxSize);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                               unsigned seed) {
  Engine engine(seed);
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto read = cairn::rockfall::parseDocument(text, "case.json");
  if (!read || engine() % 16 == 0) return LLVMFuzzerMutate(data, size, maxSize);
  Json document = read.value();
  for (std::uint64_t i = 1 + engine() % 3; i > 0; --i) changeOnce(document, engine);
  const std::string changed = document.dump();
  if (changed.size() > maxSize) return LLVMFuzzerMutate(data, size, maxSize);
  std::memcpy(data, changed.data(), changed.size());
  return changed.size();
}
