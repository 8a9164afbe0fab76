// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include "reconstruct.hpp"

namespace scene {

template Mission reconstruct<preset::reference>(const Options&, const Input&, std::ostream&);

}  // namespace scene
