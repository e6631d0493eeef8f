// SPDX-License-Identifier: Zlib
//
// All that a game with sphere-trees usually needs: trees from files, shapes, the narrow phase of a world, its budgets.
// What it leaves out has a header of its own: drawing, `.bullet` files, priorities (cairn/core), effects
// (cairn/effects).
#pragma once

#include "cairn/bullet/contact_points.h"
#include "cairn/bullet/dispatcher.h"
#include "cairn/bullet/install.h"
#include "cairn/bullet/ordered_solver.h"
#include "cairn/bullet/overlap.h"
#include "cairn/bullet/sphere_tree_shape.h"
#include "cairn/bullet/step_frame.h"
#include "cairn/bullet/terrain_shape.h"
#include "cairn/core/log.h"
#include "cairn/core/tree_file.h"
#include "cairn/core/version.h"
