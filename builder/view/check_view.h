// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/view.h"

namespace cairn::builder {

/// Whether a page can show it: its joints hang links on each other as trees, and every index names something.
Status checkView(const View& view);

}  // namespace cairn::builder
