#include "plugins/recording/recorder_module.h"

#include <sstream>
#include <stdexcept>
#include <utility>

#include "core/element/source_place.h"
#include "core/xml/xml_document.h"

namespace runnel {

namespace {

std::vector<std::string> Words(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream stream(text);
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

const FrameworkElement& ApplicationOf(const FrameworkElement& element) {
  const FrameworkElement* at = &element;
  while (at->parent() != nullptr && at->parent()->parent() != nullptr) at = at->parent();
  return *at;
}

}  // namespace

Result<void> RecorderModule::Prepare() {
  if (file.Get().empty()) {
    return Error{.message = "needs the file to record to, as parameter 'file'", .path = path()};
  }
  is_simulated_ = dynamic_cast<const ManualClock*>(&runtime().clock()) != nullptr;
  RecordedApplication about{.name = ApplicationOf(*this).name(),
                            .file = FindSourcePlace(*this).file};
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
