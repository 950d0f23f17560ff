// Recordings: what runnel.Recording reads of an MCAP file, and what an application records from now on.

#include <cstring>
#include <mutex>
#include <utility>

#include <pybind11/stl.h>

#include "apps/python/extension/bindings.h"
#include "apps/python/extension/errors.h"
#include "apps/python/extension/ports.h"
#include "apps/python/extension/value.h"
#include "plugins/command_service/command_service.h"
#include "plugins/mcap/mcap_reader.h"
#include "plugins/recording/recording_names.h"
#include "plugins/values/foxglove_channel.h"

namespace py = pybind11;

namespace runnel::python {

namespace {

struct RecordingFile {
  explicit RecordingFile(const std::string& name)
      : reader(Checked(WithoutGil([&] { return McapReader::Open(name); }))) {}
  std::unique_ptr<McapReader> reader;
  mutable std::mutex one_reads;  // never waited for with the GIL
};

// (id, path, type, encoding, values, whether it shows another one's)
py::list ChannelsOf(const RecordingFile& file) {
  const McapContents& contents = file.reader->contents();
  py::list all;
  for (const auto& [id, channel] : contents.channels) {
    const auto schema = contents.schemas.find(channel.schema);
    const auto count = contents.statistics.messages_of.find(id);
    all.append(py::make_tuple(id, PortOf(channel), schema == contents.schemas.end() ? "" : schema->second.name,
                              channel.message_encoding,
                              count == contents.statistics.messages_of.end() ? 0 : count->second, IsView(channel)));
  }
  return all;
}

py::dict AboutOf(const RecordingFile& file) {
  py::dict about;
  if (const McapMetadata* const said = file.reader->FindMetadata(kAboutMetadata)) {
    for (const auto& [name, text] : said->texts) about[py::str(name)] = text;
  }
  return about;
}

// An array of structures where NumPy has them, else a list of values.
py::object ValuesOf(const TypeInfo& type, const std::vector<std::string>& texts) {
  const py::object dtype = DtypeOf(type);
  if (!dtype.is_none()) {
    py::array array(py::reinterpret_borrow<py::dtype>(dtype),
                    std::vector<py::ssize_t>{static_cast<py::ssize_t>(texts.size())});
    auto* to = static_cast<char*>(array.mutable_data());
    const auto value = type.Make();
    for (const std::string& text : texts) {
      Checked(SetFromMessage(type, text, value.get()));
      std::memcpy(to, value.get(), type.size());
      to += type.size();
    }
    return array;
  }
  py::list all;
  for (const std::string& text : texts) {
    const Value value = NewValue(type);
    Checked(SetFromMessage(type, text, value.at));
    all.append(ToPython(type, value.at, value.memory));
  }
  return all;
}

// Published when, measured when, values; texts without a type.
py::tuple Read(const RecordingFile& file, std::uint16_t channel, const std::string& type) {
  std::vector<std::int64_t> published, measured;
  std::vector<std::string> texts;
  Checked(WithoutGil([&] {
    const std::lock_guard lock(file.one_reads);
    return file.reader->ReadMessages([&](const McapMessage& message) -> Result<void> {
      if (message.channel != channel) return {};
      published.push_back(static_cast<std::int64_t>(message.log_time));
      measured.push_back(static_cast<std::int64_t>(message.publish_time));
      texts.emplace_back(message.data);
      return {};
    });
  }));
  return py::make_tuple(published, measured, type.empty() ? py::cast(texts) : ValuesOf(TypeNamed(type), texts));
}

// What an application records from now on, until it is finished.
class RunningRecording {
 public:
  RunningRecording(Open open, const std::string& file, const std::vector<std::string>& ports,
                   const std::string& compression)
      : open_(std::move(open)) {
    std::shared_ptr<ClientRecording> begun = Checked(WithoutGil(open_, [&](Application& application) {
      static std::mutex one_at_a_time;  // the service is made when it is first asked for
      std::unique_lock lock(one_at_a_time);
      const RecordingHook& record = application.service().application().hooks.record;
      lock.unlock();
      return record({.file = file, .ports = ports, .compression = compression});
    }));
    recording_ = begun;
    open_->recordings.push_back(std::move(begun));
  }
  ~RunningRecording() {
    const auto mine = std::make_shared<std::shared_ptr<ClientRecording>>(Take());
    if (*mine) EndWithoutGil([mine, application = open_->application] { mine->reset(); });
  }
  RunningRecording(const RunningRecording&) = delete;
  RunningRecording& operator=(const RunningRecording&) = delete;

  std::string Progress() {
    if (open_->is_closed) return "finished";
    const Use use(*open_);
    const auto recording = recording_.lock();
    if (!recording) return "finished";
    if (const auto failure = recording->Failure()) Throw(*failure);
    return WithoutGil(open_, [&](Application&) { return recording->Progress(); });
  }
  std::string Finish() {
    CheckMayWait();
    if (open_->is_closed) return "finished";
    auto recording = Take();
    if (!recording) return "finished";
    return Checked(WithoutGil(open_, [&](Application&) {
      const auto mine = std::move(recording);
      return mine->Finish();
    }));
  }

 private:
  // From the application, which would end it.
  std::shared_ptr<ClientRecording> Take() {
    auto recording = recording_.lock();
    if (std::erase(open_->recordings, recording) == 0) return nullptr;
    return recording;
  }

  Open open_;
  std::weak_ptr<ClientRecording> recording_;
};

}  // namespace

void BindRecordings(py::module_& module) {
  py::class_<RunningRecording>(module, "RunningRecording", "What an application records, until it is finished.")
      .def(py::init<Open, const std::string&, const std::vector<std::string>&, const std::string&>())
      .def("progress", &RunningRecording::Progress, "How it is going, in a line; what ended it is an error.")
      .def("close", &RunningRecording::Finish, "Ends it, and says what there is. Idempotent.")
      .def("__enter__", [](const py::object& self) { return self; })
      .def("__exit__", [](RunningRecording& recording, const py::args&) { (void)recording.Finish(); });
  py::class_<RecordingFile>(module, "RecordingFile")
      .def(py::init<const std::string&>())
      .def("channels", ChannelsOf)
      .def("about", AboutOf)
      .def("read", Read);
}

}  // namespace runnel::python
