// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "cairn/builder/view.h"
#include "view/check_view.h"
#include "view/packed_array.h"
#include "view/viewer_template.h"

namespace cairn::builder {
namespace {

using Json = nlohmann::ordered_json;

// Raised when the page could misread data of another number.
constexpr int kFormat = 1;

Json vectorJson(const Vec3d& v) {
  return {v.x, v.y, v.z};
}

template <class Items, class Part>
std::string packed(const Items& items, const Part& part) {
  PackedArray array;
  for (const auto& item : items) array.add(part(item));
  return array.base64();
}

Json meshJson(const ViewLink& link, std::size_t& bytes) {
  PackedArray corners;
  for (const Triangle& triangle : link.triangles)
    for (const std::uint32_t corner : triangle) corners.add(corner);
  const Json json = {{"vertices", packed(link.vertices, [](const Vec3& v) { return v; })},
                     {"triangles", corners.base64()}};
  bytes += json.dump().size();
  return json;
}

Json spheresJson(const ViewLink& link, std::size_t& bytes) {
  const auto part = [&](auto member) { return packed(link.spheres, [=](const ViewSphere& s) { return s.*member; }); };
  const Json json = {
      {"centers", part(&ViewSphere::center)},
      {"radii", part(&ViewSphere::radius)},
      {"errors", part(&ViewSphere::error)},
      {"inner_radii", part(&ViewSphere::innerRadius)},
      {"parents", part(&ViewSphere::parent)},
      {"first_triangles", part(&ViewSphere::firstTriangle)},
      {"triangle_counts", part(&ViewSphere::triangleCount)},
      {"region_triangles", packed(link.regionTriangles, [](std::uint32_t triangle) { return triangle; })}};
  bytes += json.dump().size();
  return json;
}

Json jointJson(const ViewJoint& joint) {
  Json json = {{"name", joint.name}, {"type", joint.type}, {"parent", joint.parent}, {"child", joint.child}};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) json["rotation"].push_back(joint.rotation(row, column));
  json["translation"] = vectorJson(joint.translation);
  json["axis"] = vectorJson(joint.axis);
  json["lower"] = joint.lower;
  json["upper"] = joint.upper;
  if (const auto& mimic = joint.mimic)
    json["mimic"] = {{"joint", mimic->joint}, {"multiplier", mimic->multiplier}, {"offset", mimic->offset}};
  return json;
}

Json sceneJson(const View& view, ViewPage& page) {
  Json json = {{"format", kFormat}, {"title", view.title}, {"facts", Json::array()}};
  for (const auto& [name, value] : view.facts) json["facts"].push_back({name, value});
  json["links"] = Json::array();
  for (const ViewLink& link : view.links)
    json["links"].push_back({{"name", link.name},
                             {"origin", vectorJson(link.origin)},
                             {"diagonal", link.diagonal},
                             {"mesh", meshJson(link, page.meshBytes)},
                             {"spheres", spheresJson(link, page.sphereBytes)}});
  json["joints"] = Json::array();
  for (const ViewJoint& joint : view.joints) json["joints"].push_back(jointJson(joint));
  json["ignored_pairs"] = view.ignoredPairs;
  json["unit"] = view.isMetric ? "m" : "";
  json["up"] = view.isZUp ? "z" : "y";
  return json;
}

/// Text between the tags of an element, or in a quoted attribute.
std::string htmlEscaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

/// JSON for a script element, which ends at the first `</script` and changes its rules at `<!--`: without any `<`.
/// Bytes that are no UTF-8 become U+FFFD.
std::string scriptText(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

/// The title as the scene has it: valid UTF-8.
std::string validText(const Json& text) {
  return Json::parse(text.dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

std::string wholeTemplate() {
  std::string text;
  for (const std::string_view piece : viewerTemplate()) text += piece;
  return text;
}

}  // namespace

bool hasViewer() {
  return !viewerTemplate().empty();
}

Result<ViewPage> viewPage(const View& view) {
  if (!hasViewer())
    return Error{
        "this build has no viewer, because node or npm was missing when it was made; install both and configure again "
        "with -DCAIRN_VIEWER=ON"};
  if (Status s = checkView(view); !s) return s.error();
  ViewPage page;
  const Json scene = sceneJson(view, page);
  std::string html = wholeTemplate();
  page.viewerBytes = html.size();
  // The scene first: it stands behind the title, so that texts of the title are never searched for it.
  const std::size_t sceneAt = html.find(kScenePlace);
  html.replace(sceneAt, kScenePlace.size(), scriptText(scene));
  const std::size_t titleAt = html.find(kTitlePlace);
  html.replace(titleAt, kTitlePlace.size(), htmlEscaped(validText(scene["title"])));
  page.html = std::move(html);
  return page;
}

}  // namespace cairn::builder
