// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include "reconstruct.hpp"

namespace scene {

template void reconstruct<preset::thesis>(const Options&, const Input&);

}  // namespace scene
