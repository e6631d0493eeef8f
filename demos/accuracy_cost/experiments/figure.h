// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "accuracy_cost/experiments/table.h"

namespace cairn::accuracy_cost {

/// The look of a series: indices into the lists of colours, markers and dashes (figures/gnuplot_script.h).
struct Look {
  unsigned color = 0, marker = 0, dash = 0;
  bool line = true;     ///< a line joins the markers
  bool markers = true;  ///< false: only the line
};

/// Rows of the table, drawn as points.
struct Series {
  std::string label;  ///< in the key; series with one label look alike
  Where where;
  std::string y;  ///< column
  Look look;
};

struct Axis {
  std::string label;  ///< with the unit
  bool log = false;
  double scale = 1;  ///< factor for a column's values
};

/// One diagram. Its x is a column of numbers; with `categories` it is a column of texts, drawn side by side.
struct Panel {
  std::string title;
  std::string x;  ///< column
  Axis xAxis, yAxis;
  std::vector<Series> series;
  std::vector<std::string> categories{};
};

/// Diagrams in rows of `columns`, above one key. Drawn from the table's CSV file as NAME.svg and NAME.png.
struct Figure {
  std::string name, title;
  unsigned columns = 2;
  std::vector<Panel> panels;
};

}  // namespace cairn::accuracy_cost
