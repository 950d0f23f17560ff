#pragma once

#include <memory>
#include <string>

#include "core/module/module.h"
#include "core/port/output.h"
#include "plugins/parameters/file_path.h"
#include "plugins/parameters/static_parameter.h"
#include "plugins/recording/recorder.h"

namespace runnel {

/// What a recorder in an application says of itself.
struct RecorderState {
  std::uint64_t values = 0;
  std::uint64_t dropped = 0;
  std::uint64_t bytes = 0;
};
inline void Describe(TypeBuilder<RecorderState>& type) {
  type.Name("RecorderState")
      .Field("values", &RecorderState::values, {.description = "written so far"})
      .Field("dropped", &RecorderState::dropped, {.description = "came too fast"})
      .Field("bytes", &RecorderState::bytes, {.unit = "B", .description = "of the file"});
}

/// A Recorder as a module, for applications that always record. Begins when the application is ready, and
/// ends with it. A recording that cannot go on (a full disk) is a fault of this module.
///
/// Threads:  Update() asks the recorder how it is going. On a simulated clock it waits there until the
///           recorder has caught up, so run it in the thread whose modules publish fastest.
class RecorderModule final : public Module {
 public:
  using Module::Module;

  StaticParameter<FilePath> file{
      this, "file", {.description = "the file (MCAP) to record to; it must not be there yet"}};
  StaticParameter<std::string> ports{
      this,
      "ports",
      {.description =
           "patterns, with blanks between: /robot/** */pose !**/scan; empty: all outputs"}};
  StaticParameter<std::string> compression{
      this, "compression", {.description = "zstd, lz4, none; empty: the first that is there"}};
  Output<RecorderState> state{this, "state"};

 private:
  Result<void> Prepare() override;
  void Update() override;

  std::unique_ptr<Recorder> recorder_;
  bool is_simulated_ = false;
};

}  // namespace runnel
