// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "qwsm/sensor/imu_reading.hpp"
#include "service/dds/entities/wire_types.hpp"

/// Readings of inertial sensors on the wire (sensor_msgs/Imu).
namespace qwsm::dds {

/// A reading as a sample that is written while `frame` lives; covariances are not known.
wire::Imu ToWire(const ImuReading& reading, const std::string& frame);

/// Says why a sample must not be used; empty if it may.
std::string_view ObjectionTo(const wire::Imu& sample);

/// The reading of a sample, about the axes of its frame. @pre there is no objection to the sample.
ImuReading FromWire(const wire::Imu& sample);

}  // namespace qwsm::dds
