// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once

// The core target in one include: the loop, its policies and its maps. Never what needs Embree, FCL or a file format.
#include <vantage/core/assert.hpp>
#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/field_image.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/concepts/archetypes.hpp>
#include <vantage/concepts/channels.hpp>
#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/concepts/world.hpp>
#include <vantage/planning/straight_line.hpp>
#include <vantage/utility/mean_uncertainty.hpp>
#include <vantage/utility/uninformed.hpp>
#include <vantage/utility/variance_reduction.hpp>
#include <vantage/utility/view_distance.hpp>
#include <vantage/sampler/hemisphere.hpp>
#include <vantage/sampler/lattice.hpp>
#include <vantage/sampler/lawnmower.hpp>
#include <vantage/sampler/pattern.hpp>
#include <vantage/sampler/pool.hpp>
#include <vantage/sampler/spiral.hpp>
#include <vantage/selector/arg_max.hpp>
#include <vantage/selector/first_best.hpp>
#include <vantage/selector/in_order.hpp>
#include <vantage/selector/minus_cost.hpp>
#include <vantage/selector/per_flight_time.hpp>
#include <vantage/selector/route.hpp>
#include <vantage/selector/travel_tradeoff.hpp>
#include <vantage/loop/carry.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/mission_state.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>
