// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include "explore.hpp"

namespace scene {

template void explore<RayCast>(const Options&, const Input&);

}  // namespace scene
