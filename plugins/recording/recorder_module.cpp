#include "plugins/recording/recorder_module.h"

#include <iterator>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "core/element/element_path.h"
#include "core/element/source_place.h"
#include "core/xml/xml_document.h"

namespace runnel {

namespace {

std::vector<std::string> Words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

}  // namespace

Result<void> RecorderModule::Prepare() {
  if (file.Get().empty()) {
    return Error{.message = "needs the file to record to, as parameter 'file'", .path = path()};
  }
  is_simulated_ = dynamic_cast<const ManualClock*>(&runtime().clock()) != nullptr;
  RecordedApplication about{.name = std::string(SplitPath(path()).front())};
  {
    const std::lock_guard lock(runtime().structure_mutex());
    about.file = FindSourcePlace(*this).file;
  }
  // A recorder that was made while the application runs stands in no file.
  if (auto text = XmlDocument::ReadText(about.file)) about.text = std::move(*text);
  auto started = Recorder::Start(runtime(), nullptr,
                                 {.file = file.Get().path().string(),
                                  .ports = Words(ports.Get()),
                                  .compression = compression.Get(),
                                  .about = std::move(about)});
  if (!started) {
    Error error = started.error();
    if (error.path.empty()) error.path = path();
    return error;
  }
  recorder_ = std::move(*started);
  return {};
}

void RecorderModule::Update() {
  if (is_simulated_) recorder_->WaitForRoom();
  if (const auto failure = recorder_->TakeFailure()) {
    throw std::runtime_error("the recording has ended: " + failure->ToString());
  }
  const RecordingStatus status = recorder_->status();
  state.Publish({status.values, status.dropped, status.bytes});
}

}  // namespace runnel
