// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pugixml.hpp>
#include <string>

#include "cairn/core/result.h"

namespace cairn::builder {

/// Parses a document so that all of it, comments and white space too, can be written again. Entities are not expanded,
/// and a document type is refused. `file` is named in messages.
Status parseXml(const std::string& text, const std::string& file, pugi::xml_document& document);

/// A parsed and changed document as text. White space stays, also around the outermost element, which the parser drops.
/// `original`: what was parsed.
std::string xmlText(const pugi::xml_document& document, const std::string& original);

/// The document as text, two spaces deeper for each level.
std::string indentedXmlText(const pugi::xml_document& document);

/// The line of a node, from 1. `text` is what was parsed.
std::size_t lineOf(const std::string& text, std::ptrdiff_t offset);

}  // namespace cairn::builder
