// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include "reconstruct.hpp"

namespace scene {

template void reconstruct<preset::reference>(const Options&, const Input&);

}  // namespace scene
