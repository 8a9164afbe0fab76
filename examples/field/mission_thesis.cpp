// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include "mission.hpp"

template class field::Mission<vantage::preset::thesis>;
