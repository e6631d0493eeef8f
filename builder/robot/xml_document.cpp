// SPDX-License-Identifier: GPL-3.0-or-later
#include "robot/xml_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace cairn::builder {
namespace {

// End-of-line conversions are left out: they would change bytes that nobody asked to change.
constexpr unsigned kKeepAll = pugi::parse_cdata | pugi::parse_escapes | pugi::parse_pi | pugi::parse_comments |
                              pugi::parse_declaration | pugi::parse_doctype | pugi::parse_ws_pcdata;

std::size_t elementsIn(const pugi::xml_document& document) {
  const auto isElement = [](const pugi::xml_node& node) { return node.type() == pugi::node_element; };
  return static_cast<std::size_t>(std::count_if(document.begin(), document.end(), isElement));
}

constexpr const char* kSpace = " \t\r\n";

std::string saved(const pugi::xml_document& document, const char* indent, unsigned format) {
  std::ostringstream out;
  document.save(out, indent, format, pugi::encoding_utf8);
  return out.str();
}

/// Where the outermost element begins in the text of the document: after what stands before it.
std::size_t rootOf(const pugi::xml_document& document, const std::string& text) {
  std::size_t begin = 0;
  for (const pugi::xml_node& node : document) {
    if (node.type() == pugi::node_element) break;
    std::ostringstream out;
    node.print(out, "", pugi::format_raw | pugi::format_no_declaration, pugi::encoding_utf8);
    begin += out.str().size();
  }
  return std::min(begin, text.size());
}

}  // namespace

std::size_t lineOf(const std::string& text, std::ptrdiff_t offset) {
  const auto end = std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text.size()));
  return 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + end, '\n'));
}

Status parseXml(const std::string& text, const std::string& file, pugi::xml_document& document) {
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size(), kKeepAll, pugi::encoding_utf8);
  if (!parsed)
    return Error{fmt::format("{}:{}: the XML is not well formed ({}); correct it", file, lineOf(text, parsed.offset),
                             parsed.description())};
  const auto isDocumentType = [](const pugi::xml_node& node) { return node.type() == pugi::node_doctype; };
  if (std::any_of(document.begin(), document.end(), isDocumentType))
    return Error{fmt::format("{}: it has a document type (<!DOCTYPE>), whose entities are not read; remove it", file)};
  if (elementsIn(document) != 1)
    return Error{fmt::format("{}: it has {} outermost elements, XML has one; correct it", file, elementsIn(document))};
  return {};
}

std::string xmlText(const pugi::xml_document& document, const std::string& original) {
  const std::string text = saved(document, "", pugi::format_raw | pugi::format_no_declaration);
  const pugi::xml_node root = document.document_element();
  const std::string opening = fmt::format("<{}", root.name());
  const auto start = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, root.offset_debug() - 1));
  const std::size_t newStart = rootOf(document, text);
  if (original.compare(start, opening.size(), opening) != 0 || text.compare(newStart, opening.size(), opening) != 0)
    return text;
  return original.substr(0, start) + text.substr(newStart) + original.substr(original.find_last_not_of(kSpace) + 1);
}

std::string indentedXmlText(const pugi::xml_document& document) {
  return saved(document, "  ", pugi::format_indent);
}

}  // namespace cairn::builder
