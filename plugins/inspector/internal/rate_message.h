#pragma once

#include <string>
#include <vector>

#include "plugins/inspector/structure_mirror.h"

namespace runnel::internal {

/// What has been published and run between two samples of the same elements, as the protocol has it.
/// `told`: the rates that were told last, of which only other ones are told; kept up to date.
[[nodiscard]] std::string RateMessage(const CountSample& before, const CountSample& now,
                                      double time, std::vector<double>& told);

}  // namespace runnel::internal
