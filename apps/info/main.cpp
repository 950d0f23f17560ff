// The command `runnel info`: says what is in a recording, for people or as JSON. One that is broken, or was never
// finished, is shown as far as it goes; what is wrong with it goes to stderr.

#include <algorithm>
#include <cstdio>
#include <iostream>

#include <fmt/ranges.h>

#include "apps/program.h"
#include "plugins/mcap/mcap_reader.h"
#include "plugins/recording/recording_info.h"

namespace runnel {

namespace {

void PrintLine(std::string_view name, const std::string& text) {
  if (!text.empty()) fmt::print("{:<12} {}\n", Printable(name), Printable(text));
}

std::string PackingText(const RecordingInfo& info) {
  std::string text = std::to_string(info.chunks) + (info.chunks == 1 ? " chunk, " : " chunks, ");
  if (info.compression == "none") return text + "not compressed";
  return text + info.compression + ", " + SizeText(info.compressed_bytes) + " of " + SizeText(info.uncompressed_bytes);
}

void PrintChannels(std::vector<RecordingInfo::Channel> channels) {
  std::size_t path_width = 4, type_width = 4;
  for (auto& each : channels) {
    each.path = Printable(each.path);
    each.type = Printable(each.type);
    path_width = std::max(path_width, each.path.size());
    type_width = std::max(type_width, each.type.size());
  }
  fmt::print("\n{:<{}}  {:<{}}  {:>10}  {:>10}  {:>10}\n", "port", path_width, "type", type_width, "values", "rate",
             "dropped");
  for (const auto& each : channels) {
    fmt::print("{:<{}}  {:<{}}  {:>10}  {:7.2f} Hz  {:>10}\n", each.path, path_width, each.type, type_width,
               each.values, each.rate, each.dropped);
  }
}

void Print(const RecordingInfo& info) {
  PrintLine("file", info.file + ", " + SizeText(info.bytes));
  PrintLine("duration", fmt::format("{:.3f} s, from {:.3f} s to {:.3f} s", info.duration(), info.start, info.end));
  PrintLine("values", std::to_string(info.values) + " of " + std::to_string(info.ports) + " ports, " +
                          std::to_string(info.dropped) + " more came too fast or could not be written");
  PrintLine("chunks", PackingText(info));
  for (const auto& [key, text] : info.about) PrintLine(key, text);
  if (info.about.empty()) PrintLine("library", info.library);
  PrintLine("attached", fmt::format("{}", fmt::join(info.attachments, ", ")));
  PrintLine("end",
            info.ended_properly ? "as its writer wanted it" : "missing: its writer was killed, or is still at work");
  if (!info.channels.empty()) PrintChannels(info.channels);
  std::fflush(stdout);
}

int ShowRecording(const std::string& file, bool is_json) {
  const auto reader = McapReader::Open(file);
  if (!reader) return Fail(reader.error());
  const RecordingInfo info = InfoOf(**reader);
  if (is_json) {
    std::cout << RecordingInfoJson(info) << '\n' << std::flush;
  } else {
    Print(info);
  }
  return info.damage ? Fail(*info.damage, exit_code::kRunFailed) : exit_code::kDone;
}

}  // namespace

}  // namespace runnel

int main(int count, char** words) {
  CLI::App program("Says what is in a recording.", "runnel info");
  std::string file;
  bool is_json = false;
  program.add_option("recording", file, "file (MCAP)")->required()->type_name("FILE.mcap");
  program.add_flag("--json", is_json, "for programs");
  return runnel::RunProgram(program, count, words, [&] { return runnel::ShowRecording(file, is_json); });
}
