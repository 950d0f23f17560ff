#include "modules/simulation/algorithm/run_result.h"

namespace runnel {

std::vector<PathSample> ThinnedPath(const std::vector<PathSample>& path, double step) {
  std::vector<PathSample> thinned;
  for (const PathSample& sample : path) {
    if (thinned.empty() || Distance(thinned.back().position, sample.position) >= step) {
      thinned.push_back(sample);
    }
  }
  if (!path.empty() && thinned.back().time < path.back().time) thinned.push_back(path.back());
  return thinned;
}

}  // namespace runnel
