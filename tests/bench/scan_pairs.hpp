// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// nanoflann 1.4.3 is not free of warnings under ours.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#include <nanoflann.hpp>
#pragma GCC diagnostic pop

#include "service/io/clouds/uos_scan.hpp"
#include "slam6d/icp/icp.hpp"

namespace slam6d::bench {

/// Processor time of this process: what others do on the machine hardly shows in it.
inline double ProcessorSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Runs the work and returns the milliseconds it took.
template <class Work>
double Milliseconds(const Work& work) {
  const double start_s = ProcessorSeconds();
  work();
  return 1e3 * (ProcessorSeconds() - start_s);
}

struct ScanPair {
  std::string name;
  PointCloud ref;
  PointCloud cur;
  Pose3 T_ref_cur_guess;
  std::optional<Pose3> T_ref_cur_truth;
};

inline Pose3 RelativePose(const std::filesystem::path& folder) {
  return io::ReadUosPose(folder / "scan000.pose").Inverse() *
         io::ReadUosPose(folder / "scan001.pose");
}

inline ScanPair ReadPair(const std::filesystem::path& data, const std::string& name) {
  const std::filesystem::path folder = data / "scans3d" / name;
  // The demo scans of 3DTK hold misses as points at 32.77 m.
  const double max_range_m = name == "dat_3dtk" ? 32.0 : 1e9;
  ScanPair pair{.name = name,
                .ref = InRange(io::ReadUosPoints(folder / "scan000.3d").cloud, 0.1, max_range_m),
                .cur = InRange(io::ReadUosPoints(folder / "scan001.3d").cloud, 0.1, max_range_m),
                .T_ref_cur_guess = RelativePose(folder),
                .T_ref_cur_truth = {}};
  if (std::filesystem::exists(folder / "gt")) pair.T_ref_cur_truth = RelativePose(folder / "gt");
  return pair;
}

/// The instructions named by the second argument, or the best of this machine; printed, as all
/// ratios depend on them.
inline KdTreeOptions ReadTreeOptions(int argc, char** argv) {
  KdTreeOptions options;
  const std::string wanted = argc > 2 ? argv[2] : "best";
  for (const auto& [name, level] : Names(SimdLevel{})) {
    if (name == wanted) options.simd = level;
  }
  const SimdLevel used = AvailableSimd(options.simd);
  for (const auto& [name, level] : Names(SimdLevel{})) {
    if (level == used) std::printf("instructions: %s\n", std::string(name).c_str());
  }
  return options;
}

/// The pairs that exist under the data folder named by the first argument, or QWSM_DATA_DIR.
inline std::vector<ScanPair> ReadPairs(int argc, char** argv) {
  const std::filesystem::path data = argc > 1 ? argv[1] : QWSM_DATA_DIR;
  std::vector<ScanPair> pairs;
  for (const char* name : {"p20k", "p100k", "car", "dat_3dtk"}) {
    if (std::filesystem::exists(data / "scans3d" / name)) pairs.push_back(ReadPair(data, name));
  }
  return pairs;
}

/// A cloud as nanoflann reads it, in the order of the file, and its tree with the usual leaf size.
class NanoflannTree {
 public:
  explicit NanoflannTree(const PointCloud& cloud) : points_(cloud), tree_(3, points_, {10}) {}

  struct Found {
    std::size_t index;
    double distance2_m2;
  };

  Found FindNearest(const Eigen::Vector3d& query_m) const {
    Found found{};
    nanoflann::KNNResultSet<double, std::size_t> result(1);
    result.init(&found.index, &found.distance2_m2);
    tree_.findNeighbors(result, query_m.data(), nanoflann::SearchParams());
    return found;
  }

 private:
  struct Points {
    explicit Points(const PointCloud& cloud) {
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        at_m.push_back({cloud.x_m()[i], cloud.y_m()[i], cloud.z_m()[i]});
      }
    }
    std::size_t kdtree_get_point_count() const { return at_m.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const { return at_m[i][axis]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
    std::vector<std::array<double, 3>> at_m;
  };
  using Metric = nanoflann::L2_Simple_Adaptor<double, Points>;

  Points points_;
  nanoflann::KDTreeSingleIndexAdaptor<Metric, Points, 3, std::size_t> tree_;
};

}  // namespace slam6d::bench
