#pragma once

#include "plugins/application/application_extension.h"

namespace runnel {

/// Has an application load files of FINROC as well.
class FinrocForm final : public ApplicationExtension {
 public:
  std::optional<BuildOutcome> Build(const ApplicationFile& file, const BuildTools& tools) override;
};

}  // namespace runnel
