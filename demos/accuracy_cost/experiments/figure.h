// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "accuracy_cost/experiments/table.h"

namespace cairn::accuracy_cost {

/// How a series looks: places in the house's lists of colours, markers and dashes (figures/gnuplot_script.h).
struct Look {
  unsigned color = 0, marker = 0, dash = 0;
  bool line = true;     ///< markers joined by a line
  bool markers = true;  ///< else the line alone
};

/// Rows of the table as points.
struct Series {
  std::string label;  ///< in the key; series of one label look alike
  Where where;
  std::string y;  ///< column
  Look look;
};

struct Axis {
  std::string label;  ///< with the unit
  bool log = false;
  double scale = 1;  ///< what a column's values are multiplied by
};

/// One diagram. Its x is a column of numbers, or with `categories` a column of texts drawn side by side.
struct Panel {
  std::string title;
  std::string x;  ///< column
  Axis xAxis, yAxis;
  std::vector<Series> series;
  std::vector<std::string> categories{};
};

/// Diagrams in rows of `columns`, over one key: NAME.svg and NAME.png, drawn from the table's CSV file.
struct Figure {
  std::string name, title;
  unsigned columns = 2;
  std::vector<Panel> panels;
};

}  // namespace cairn::accuracy_cost
