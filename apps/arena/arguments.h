#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace runnel::arena {

/// What holds for all runs alike, and is not told by their names.
struct RunSettings {
  double noise = 0.0;           ///< m, standard deviation of the ranges measured
  double path_step = 0.1;       ///< m, between points of the paths kept
  double time_limit = 0.0;      ///< s, simulated; 0: TimeLimitOf the course
  double safe_distance = 0.35;  ///< m, of the robot's centre from obstacles

  friend bool operator==(const RunSettings&, const RunSettings&) = default;
};

/// The words of the command line, not yet compared with what there is.
struct ArenaArguments {
  std::vector<std::string> worlds = {};
  std::vector<std::string> variants = {"all"};
  std::vector<std::string> sensors = {"laser"};
  std::vector<std::string> directions = {"left"};
  std::vector<std::uint64_t> seeds = {1};
  std::vector<std::string> plugins = {};  ///< besides those of the product
  RunSettings settings = {};
  int jobs = 1;
  double wall_limit = 120.0;  ///< s, after which a run is taken to hang
  std::size_t shard = 1;      ///< which part of the runs, from 1 on ...
  std::size_t shards = 1;     ///< ... of how many
  std::string json = {};      ///< "": none, as those below
  std::string svg = {};
  std::string html = {};
  bool resume = false;
  bool quiet = false;
};

/// Errors: what the parser says, numbers out of their ranges. An empty message: help has been
/// printed, and nothing is left to do.
[[nodiscard]] Result<ArenaArguments> ParseArguments(int count, const char* const* words);

}  // namespace runnel::arena
