// SPDX-License-Identifier: GPL-3.0-or-later
#include "bound/packing_program.h"

#include <glpk.h>

#include <algorithm>

namespace cairn::builder {
namespace {

/// Steps of the solver between two questions whether to go on: a fraction of a second. The next call starts from the
/// basis that was reached.
constexpr int kStepsAtOnce = 200;

}  // namespace

struct PackingProgram::Solver {
  glp_prob* problem = glp_create_prob();
  int columns = 0;
  ~Solver() { glp_delete_prob(problem); }
};

PackingProgram::PackingProgram(std::size_t columns) : solver_(std::make_unique<Solver>()) {
  glp_prob* problem = solver_->problem;
  solver_->columns = static_cast<int>(columns);
  glp_set_obj_dir(problem, GLP_MAX);
  glp_add_cols(problem, solver_->columns);
  for (int c = 1; c <= solver_->columns; ++c) {
    glp_set_col_bnds(problem, c, GLP_DB, 0, 1);
    glp_set_obj_coef(problem, c, 1);
  }
}

PackingProgram::~PackingProgram() = default;

void PackingProgram::addRow(std::span<const std::uint32_t> points) {
  // The library counts from 1, in rows, columns and arrays.
  std::vector<int> columns{0};
  for (const std::uint32_t p : points) columns.push_back(static_cast<int>(p) + 1);
  const std::vector<double> ones(columns.size(), 1);
  const int row = glp_add_rows(solver_->problem, 1);
  glp_set_row_bnds(solver_->problem, row, GLP_UP, 0, 1);
  glp_set_mat_row(solver_->problem, row, static_cast<int>(points.size()), columns.data(), ones.data());
}

std::vector<double> PackingProgram::solve(const KeepGoing& keepGoing) {
  glp_smcp options;
  glp_init_smcp(&options);
  options.msg_lev = GLP_MSG_OFF;
  options.meth = GLP_DUALP;
  options.it_lim = kStepsAtOnce;
  int ended = GLP_EITLIM;
  while (ended == GLP_EITLIM && keepGoing()) ended = glp_simplex(solver_->problem, &options);
  if (ended != 0 || glp_get_status(solver_->problem) != GLP_OPT) return {};
  std::vector<double> weights;
  for (int c = 1; c <= solver_->columns; ++c) weights.push_back(std::max(0.0, glp_get_col_prim(solver_->problem, c)));
  return weights;
}

}  // namespace cairn::builder
