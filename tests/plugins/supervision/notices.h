#pragma once

#include <vector>

#include "plugins/supervision/supervisor.h"

namespace runnel::test {

/// What has been done since the last call, oldest first.
inline std::vector<Notice> NoticesOf(Supervisor& supervisor) {
  std::vector<Notice> taken;
  supervisor.TakeNotices(taken);
  return taken;
}

}  // namespace runnel::test
