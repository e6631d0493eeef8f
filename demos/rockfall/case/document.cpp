// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/document.h"

#include <fmt/format.h>

#include <optional>
#include <set>
#include <vector>

namespace cairn::rockfall {
namespace {

constexpr int kNumberOverflow = 406;  // the library's number of this error

/// Follows the parser through the text, because its result has only the last of equal keys.
class DuplicateFinder {
 public:
  void operator()(Json::parse_event_t event, const Json& parsed) {
    switch (event) {
      case Json::parse_event_t::object_start:
      case Json::parse_event_t::array_start:
        enterElement();
        open_.push_back({event == Json::parse_event_t::array_start, 0, {}, {}});
        break;
      case Json::parse_event_t::object_end:
      case Json::parse_event_t::array_end:
        open_.pop_back();
        break;
      case Json::parse_event_t::key:
        open_.back().key = parsed.get<std::string>();
        if (!open_.back().keys.insert(open_.back().key).second && !duplicate_) duplicate_ = path();
        break;
      case Json::parse_event_t::value:
        enterElement();
        break;
    }
  }

  /// Path of the first repeated key.
  const std::optional<std::string>& duplicate() const { return duplicate_; }
  /// Path of the value that comes next.
  std::string next() {
    enterElement();
    return path();
  }

 private:
  struct Open {
    bool isArray;
    std::size_t elements;  // number of elements begun so far
    std::string key;       // the last key read
    std::set<std::string> keys;
  };

  void enterElement() {
    if (!open_.empty() && open_.back().isArray) ++open_.back().elements;
  }

  std::string path() const {
    std::string path;
    for (const Open& open : open_) path = open.isArray ? pathInto(path, open.elements - 1) : pathInto(path, open.key);
    return path;
  }

  std::vector<Open> open_;
  std::optional<std::string> duplicate_;
};

/// nlohmann's message without its own prefix: "parse error at line 3, column 5: ...".
std::string plainMessage(const std::string& message) {
  const std::size_t end = message.find("] ");
  return end == std::string::npos ? message : message.substr(end + 2);
}

}  // namespace

Result<Json> parseDocument(std::string_view text, const std::string& file) {
  DuplicateFinder finder;
  const auto follow = [&](int /*depth*/, Json::parse_event_t event, Json& parsed) {
    finder(event, parsed);
    return true;
  };
  try {
    Json document = Json::parse(text.begin(), text.end(), follow, true, true);
    if (finder.duplicate())
      return Error{inOneLine(fmt::format("{}: {}: this key is given twice", file, *finder.duplicate()))};
    return document;
  } catch (const Json::exception& error) {
    // Of numbers too large for it the library tells no place.
    const std::string where = error.id == kNumberOverflow ? finder.next() : "this is not JSON";
    return Error{fmt::format("{}: {}: {}", file, where, plainMessage(error.what()))};
  }
}

std::string inOneLine(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (c == '\n')
      line += "\\n";
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      line += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    else
      line += c;
  }
  return line;
}

std::string pathInto(const std::string& path, std::string_view key) {
  std::string escaped = path + '/';
  for (const char c : key) {
    if (c == '~')
      escaped += "~0";
    else if (c == '/')
      escaped += "~1";
    else
      escaped += c;
  }
  return escaped;
}

std::string pathInto(const std::string& path, std::size_t index) {
  return fmt::format("{}/{}", path, index);
}

}  // namespace cairn::rockfall
