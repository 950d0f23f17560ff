#include "plugins/recording/recording_info.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/base/number_text.h"
#include "plugins/mcap/mcap_reader.h"
#include "plugins/recording/recording_names.h"
#include "plugins/values/json_writer.h"

namespace runnel {

namespace {

using Drops = std::map<std::string, std::uint64_t, std::less<>>;

// Each such record has all counts until then.
Drops DropsOf(const McapContents& contents) {
  Drops drops;
  for (const McapMetadata& metadata : contents.metadata) {
    if (metadata.name != kDropsMetadata) continue;
    for (const auto& [path, text] : metadata.texts) {
      drops[path] = NumberIn<std::uint64_t>(text).value_or(0);
    }
  }
  return drops;
}

std::string CompressionText(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : ", ") + (name.empty() ? "none" : name);
  }
  return text.empty() ? "none" : text;
}

double Seconds(std::uint64_t nanoseconds) { return static_cast<double>(nanoseconds) * 1e-9; }

}  // namespace

std::string AboutText(const McapReader& reader, std::string_view key) {
  const McapMetadata* const about = reader.FindMetadata(kAboutMetadata);
  const std::string* const text = about != nullptr ? FindText(about->texts, key) : nullptr;
  return text != nullptr ? *text : "";
}

RecordingInfo InfoOf(const McapReader& reader) {
  const McapContents& contents = reader.contents();
  const McapStatistics& all = contents.statistics;
  RecordingInfo info{.file = reader.file(), .bytes = reader.size()};
  info.ended_properly = contents.ended_properly;
  info.damage = contents.damage;
  info.library = contents.header.library;
  if (const auto* about = reader.FindMetadata(kAboutMetadata)) info.about = about->texts;
  for (const auto& each : contents.attachments) info.attachments.push_back(each.attachment.name);
  info.start = Seconds(all.start);
  info.end = Seconds(all.end);
  std::set<std::string> compressions;
  for (const McapChunk& chunk : contents.chunks) {
    compressions.insert(chunk.compression);
    info.compressed_bytes += chunk.compressed_size;
    info.uncompressed_bytes += chunk.size;
  }
  info.chunks = contents.chunks.size();
  info.compression = CompressionText(compressions);
  Drops drops = DropsOf(contents);
  for (const auto& [path, count] : drops) info.dropped += count;
  for (const auto& [id, channel] : contents.channels) {
    const auto schema = contents.schemas.find(channel.schema);
    const auto count = all.messages_of.find(id);
    RecordingInfo::Channel& added = info.channels.emplace_back();
    added.is_view = IsView(channel);
    added.path = added.is_view ? channel.topic : PortOf(channel);
    added.type = schema != contents.schemas.end() ? schema->second.name : "";
    added.encoding = channel.message_encoding;
    added.values = count != all.messages_of.end() ? count->second : 0;
    if (const auto dropped = drops.find(added.path); dropped != drops.end()) {
      added.dropped = dropped->second;
    }
    if (!added.is_view) {
      ++info.ports;
      info.values += added.values;
    }
    if (info.duration() > 0) added.rate = static_cast<double>(added.values) / info.duration();
  }
  std::ranges::stable_sort(info.channels, {}, &RecordingInfo::Channel::path);
  return info;
}

std::string RecordingInfoJson(const RecordingInfo& info) {
  return JsonObjectText([&](JsonObject& object) {
    object.Add("file", info.file).Add("bytes", info.bytes);
    object.Add("ended_properly", info.ended_properly);
    if (info.damage) object.Add("damage", info.damage->message);
    object.Add("library", info.library);
    {
      JsonObject about(object.Key("about"));
      for (const auto& [key, text] : info.about) about.Add(key, text);
    }
    {
      JsonArray attachments(object.Key("attachments"));
      for (const std::string& name : info.attachments) attachments.Add(name);
    }
    object.Add("start", info.start).Add("end", info.end).Add("duration", info.duration());
    object.Add("ports", info.ports).Add("values", info.values).Add("dropped", info.dropped);
    object.Add("chunks", info.chunks).Add("compression", info.compression);
    object.Add("packed_bytes", info.compressed_bytes);
    object.Add("unpacked_bytes", info.uncompressed_bytes);
    JsonArray channels(object.Key("channels"));
    for (const RecordingInfo::Channel& each : info.channels) {
      JsonObject channel(channels.Next());
      channel.Add("path", each.path).Add("type", each.type).Add("encoding", each.encoding);
      channel.Add("values", each.values).Add("rate", each.rate).Add("dropped", each.dropped);
      channel.Add("is_view", each.is_view);
    }
  });
}

std::string SizeText(std::uint64_t bytes) {
  const auto size = static_cast<double>(bytes);
  if (bytes < 1000) return fmt::format("{} B", bytes);
  if (bytes < 1'000'000) return fmt::format("{:.1f} kB", size / 1e3);
  if (bytes < 1'000'000'000) return fmt::format("{:.1f} MB", size / 1e6);
  return fmt::format("{:.2f} GB", size / 1e9);
}

}  // namespace runnel
