// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/figures/gnuplot_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace cairn::accuracy_cost {
namespace {

/// Okabe and Ito's colours with black; the ones that are light on white come last.
constexpr std::array kColors{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#E69F00", "#56B4E9"};
/// Gnuplot's numbers of filled and open markers that look alike in both terminals.
constexpr std::array kMarkers{7, 5, 9, 11, 13, 6, 4, 8, 10, 12};
constexpr std::array kDashes{1, 2, 4, 5, 3};

/// Pixels.
constexpr int kWidth = 1360, kPanelHeight = 316, kTitleHeight = 46, kKeyLine = 24, kKeyMargin = 14;
/// Pixels for a letter of the key, with its sample.
constexpr int kLetter = 8, kSample = 64;

std::string quoted(const std::string& text) {
  std::string escaped = "'";
  for (const char c : text) escaped += c == '\'' ? std::string("''") : std::string(1, c);
  return escaped + "'";
}

/// Labels of tics are formats.
std::string ticLabel(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '%' ? std::string("%%") : std::string(1, c);
  return escaped;
}

const char* colorOf(const Look& look) {
  return kColors[look.color % kColors.size()];
}

std::string styleOf(const Look& look) {
  const int marker = kMarkers[look.marker % kMarkers.size()];
  if (!look.line) return fmt::format("with points lc rgb '{}' pt {} ps 1", colorOf(look), marker);
  if (!look.markers)
    return fmt::format("with lines lc rgb '{}' lw 1.4 dt {}", colorOf(look), kDashes[look.dash % kDashes.size()]);
  return fmt::format("with linespoints lc rgb '{}' pt {} ps 0.8 lw 1.6 dt {}", colorOf(look), marker,
                     kDashes[look.dash % kDashes.size()]);
}

/// A condition on a row of the file.
std::string conditionOf(const Where& where) {
  std::string text = "1";
  for (const auto& [column, value] : where) text += fmt::format(" && strcol({}) eq {}", quoted(column), quoted(value));
  return text;
}

/// The column of a panel's x: a number, or the index of a text in the list.
std::string xOf(const Panel& panel) {
  if (panel.categories.empty()) return fmt::format("column({})*{}", quoted(panel.x), panel.xAxis.scale);
  std::string text = "NaN";
  for (std::size_t i = panel.categories.size(); i-- > 0;)
    text = fmt::format("(strcol({}) eq {} ? {} : {})", quoted(panel.x), quoted(panel.categories[i]), i, text);
  return text;
}

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = 0;
};

Range rangeOf(const std::vector<std::pair<std::string, Where>>& columns, const Table& table) {
  Range range;
  for (const auto& [column, where] : columns)
    for (const double value : table.numbers(column, where)) {
      if (!(value > 0)) continue;
      range.low = std::min(range.low, value);
      range.high = std::max(range.high, value);
    }
  return range;
}

/// From this range of the data on, a logarithmic axis has enough labels.
constexpr double kLogFrom = 6;
/// Free margin beyond the data, as a fraction of their range.
constexpr double kRoom = 0.07;

void addAxis(std::string& script, char axis, const Axis& description, const Range& range) {
  const auto out = std::back_inserter(script);
  fmt::format_to(out, "set {}label {}\nset format {} '%g'\n", axis, quoted(description.label), axis);
  fmt::format_to(out, "unset logscale {}\n", axis);
  const double low = range.low * description.scale, high = range.high * description.scale;
  if (!(high > 0)) {
    fmt::format_to(out, "set {}range [*:*]\n", axis);
  } else if (description.log && high > kLogFrom * low) {
    const double room = std::max(1.1, std::pow(high / low, kRoom));
    fmt::format_to(out, "set logscale {} {}\nset {}range [{}:{}]\n", axis, high > 100 * low ? 10 : 2, axis, low / room,
                   high * room);
  } else {
    fmt::format_to(out, "set {}range [0:{}]\n", axis, high * (1 + kRoom));
  }
}

void addAxes(std::string& script, const Panel& panel, const Table& table) {
  const auto out = std::back_inserter(script);
  std::vector<std::pair<std::string, Where>> xs, ys;
  for (const Series& series : panel.series) {
    if (panel.categories.empty()) xs.emplace_back(panel.x, series.where);
    ys.emplace_back(series.y, series.where);
  }
  addAxis(script, 'x', panel.xAxis, rangeOf(xs, table));
  addAxis(script, 'y', panel.yAxis, rangeOf(ys, table));
  if (panel.categories.empty()) {
    fmt::format_to(out, "set xtics auto norotate\n");
    return;
  }
  fmt::format_to(out, "set xrange [-0.6:{}]\nset xtics rotate by 35 right (",
                 static_cast<double>(panel.categories.size()) - 0.4);
  for (std::size_t i = 0; i < panel.categories.size(); ++i)
    fmt::format_to(out, "{}{} {}", i > 0 ? ", " : "", quoted(ticLabel(panel.categories[i])), i);
  script += ")\n";
}

/// Panels of categories need room for slanted names.
int bottomOf(const Panel& panel) {
  return panel.categories.empty() ? 74 : 104;
}

void addPanel(std::string& script, const Panel& panel, const Table& table, const std::string& csv) {
  const auto out = std::back_inserter(script);
  fmt::format_to(out, "set title {}\n", quoted(panel.title));
  addAxes(script, panel, table);
  script += "plot ";
  bool first = true;
  for (const Series& series : panel.series) {
    if (table.numbers(series.y, series.where).empty()) continue;
    fmt::format_to(out, "{}{} using ({} ? {} : NaN):(column({})*{}) {} notitle", first ? "" : ", \\\n  ", quoted(csv),
                   conditionOf(series.where), xOf(panel), quoted(series.y), panel.yAxis.scale, styleOf(series.look));
    first = false;
  }
  script += first ? "NaN notitle\n" : "\n";
}

/// The series of different labels, in their first order.
std::vector<const Series*> keyOf(const Figure& figure) {
  std::vector<const Series*> key;
  for (const Panel& panel : figure.panels)
    for (const Series& series : panel.series)
      if (std::ranges::none_of(key, [&](const Series* s) { return s->label == series.label; })) key.push_back(&series);
  return key;
}

struct Layout {
  int width = kWidth, height = 0, rows = 0, keyHeight = 0, keyColumns = 1;
};

Layout layoutOf(const Figure& figure, const std::vector<const Series*>& key) {
  Layout layout;
  std::size_t longest = 1;
  for (const Series* series : key) longest = std::max(longest, series->label.size());
  layout.keyColumns = std::max(1, kWidth / (static_cast<int>(longest) * kLetter + kSample));
  const int entries = static_cast<int>(key.size());
  layout.keyHeight = kKeyLine * ((entries + layout.keyColumns - 1) / layout.keyColumns) + kKeyMargin;
  const auto panels = static_cast<int>(figure.panels.size()), columns = static_cast<int>(figure.columns);
  layout.rows = (panels + columns - 1) / columns;
  layout.height = kTitleHeight + layout.rows * kPanelHeight + layout.keyHeight;
  return layout;
}

void addKey(std::string& script, const std::vector<const Series*>& key, const Layout& layout) {
  const auto out = std::back_inserter(script);
  script += "unset title\nunset xlabel\nunset ylabel\nunset tics\nunset border\nunset grid\nunset logscale\n";
  fmt::format_to(
      out, "set lmargin at screen 0\nset rmargin at screen 1\nset bmargin at screen 0\nset tmargin at screen {}\n",
      static_cast<double>(layout.keyHeight) / layout.height);
  fmt::format_to(out, "set key on inside center center horizontal maxcols {} samplen 3 width 1\n", layout.keyColumns);
  script += "set xrange [0:1]\nset yrange [0:1]\nplot ";
  for (std::size_t i = 0; i < key.size(); ++i)
    fmt::format_to(out, "{}NaN {} title {}", i > 0 ? ", \\\n  " : "", styleOf(key[i]->look), quoted(key[i]->label));
  script += "\n";
}

void addMargins(std::string& script, const Figure& figure, const Layout& layout, std::size_t index) {
  constexpr int kLeft = 78, kRight = 16, kTop = 30;
  const auto column = static_cast<int>(index % figure.columns), row = static_cast<int>(index / figure.columns);
  const double width = static_cast<double>(layout.width) / figure.columns, height = layout.height;
  const double top = height - kTitleHeight - row * kPanelHeight;
  fmt::format_to(
      std::back_inserter(script),
      "set lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {}\nset bmargin at screen {}\n",
      (column * width + kLeft) / layout.width, ((column + 1) * width - kRight) / layout.width, (top - kTop) / height,
      (top - kPanelHeight + bottomOf(figure.panels[index])) / height);
}

}  // namespace

std::string gnuplotScript(const Figure& figure, const Table& table, const std::filesystem::path& csv,
                          PictureFormat format, const std::filesystem::path& output) {
  const std::vector<const Series*> key = keyOf(figure);
  const Layout layout = layoutOf(figure, key);
  std::string script;
  const auto out = std::back_inserter(script);
  fmt::format_to(out, "set terminal {} size {},{} noenhanced font 'sans,{}' background 'white'\n",
                 format == PictureFormat::svg ? "svg" : "pngcairo", layout.width, layout.height,
                 format == PictureFormat::svg ? 13 : 10);
  fmt::format_to(out, "set output {}\n", quoted(output.string()));
  script += "set datafile separator ','\nset datafile columnheaders\nset datafile missing NaN\nset encoding utf8\n";
  fmt::format_to(out, "set multiplot title {} font 'sans,{}'\n", quoted(figure.title),
                 format == PictureFormat::svg ? 17 : 13);
  script += "set key off\nset grid lc rgb '#DDDDDD'\nset border lc rgb '#555555'\nset tics nomirror\n";
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    addMargins(script, figure, layout, i);
    addPanel(script, figure.panels[i], table, csv.string());
  }
  addKey(script, key, layout);
  script += "unset multiplot\n";
  return script;
}

}  // namespace cairn::accuracy_cost
