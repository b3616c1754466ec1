// SPDX-License-Identifier: GPL-3.0-or-later
//
// Data with which the Python side creates YADE's bodies.
#pragma once

#include <boost/python/dict.hpp>
#include <boost/python/list.hpp>

#include "coupler/protocol/records.hpp"
#include "coupler/protocol/settings.hpp"
#include "granular_adapter/nscd/problem/bodies.hpp"

namespace turbidite::yade {

/// Keys and values as strings.
boost::python::dict settings_dict(const Settings& settings);

/// One dict per body: id, radius, density, mass, inertia, position, orientation (w, x, y, z),
/// velocity, angular_velocity, and vertices ((x, y) in the body's axes [m]; none for a disc, and
/// for every body if there is no table of shapes).
boost::python::list grain_list(const nscd::Bodies& bodies, const ShapeTable& shapes = {});

}  // namespace turbidite::yade
