// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#pragma once

#include "eigengrasp/modeling/solid.hpp"

namespace eigengrasp::make_objects {

/// One millimetre [m]; the designs are drawn in millimetres.
inline constexpr double mm = 1e-3;

// Each design: z up in the natural pose, origin near the centre of the body.
modeling::Solid ashtray();  ///< round, with a bowl and four notches
modeling::Solid glass();    ///< thin-walled tumbler with a thick base
modeling::Solid flask();    ///< conical laboratory flask with a neck and a lip, hollow
modeling::Solid phone();    ///< cordless handset on its back, antenna towards +x
modeling::Solid plane();    ///< toy fighter with a propeller, nose towards +x
modeling::Solid shoe();     ///< low shoe of a right foot, hollow, toe towards +x

}  // namespace eigengrasp::make_objects
