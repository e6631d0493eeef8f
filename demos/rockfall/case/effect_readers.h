// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "rockfall/case/effect_options.h"

namespace cairn::rockfall {

// One reader for each effect; the key "effect" was read before.

EffectOptions readFriction(Object& object, const Materials& materials);
EffectOptions readRollingResistance(Object& object, const Materials& materials);
EffectOptions readRestitution(Object& object, const Materials& materials);
EffectOptions readTangentialRestitution(Object& object, const Materials& materials);
EffectOptions readSlipFriction(Object& object, const Materials& materials);
EffectOptions readSurfaceRoughness(Object& object, const Materials& materials);
EffectOptions readSoilScarring(Object& object, const Materials& materials);

EffectOptions readGyroscopic(Object& object, const Materials& materials);
EffectOptions readCcd(Object& object, const Materials& materials);
EffectOptions readSleeping(Object& object, const Materials& materials);
EffectOptions readFragmentation(Object& object, const Materials& materials);
EffectOptions readEvents(Object& object, const Materials& materials);

EffectOptions readAirDrag(Object& object, const Materials& materials);
EffectOptions readWater(Object& object, const Materials& materials);
EffectOptions readForestDrag(Object& object, const Materials& materials);
EffectOptions readTrees(Object& object, const Materials& materials);
EffectOptions readBarrier(Object& object, const Materials& materials);
EffectOptions readGroundDrag(Object& object, const Materials& materials);

}  // namespace cairn::rockfall
