// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A sampler of regions that is told of no kind of them.
// expect: RoiAndLocal
// expect: looks at no kind of region
// expect: name some, or take Local
#include <vantage/sampler/roi_and_local.hpp>

vantage::RoiAndLocal<> sampler;
