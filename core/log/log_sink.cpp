#include "core/log/log_sink.h"

#include <utility>

#include "core/log/internal/log_dispatcher.h"

namespace runnel {

LogSink::LogSink(Runtime& runtime, Receive receive) {
  internal::LogDispatcher::OfProcess().Add(*this, runtime, std::move(receive));
}

LogSink::~LogSink() { internal::LogDispatcher::OfProcess().Remove(*this); }

void FlushLog() { internal::LogDispatcher::OfProcess().Flush(); }

}  // namespace runnel
