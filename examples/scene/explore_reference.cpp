// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include "explore.hpp"

namespace scene {

template Mission explore<Projective>(const Options&, const Input&, std::ostream&);

}  // namespace scene
