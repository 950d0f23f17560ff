#include "plugins/mcap/mcap_writer.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "core/base/check.h"
#include "plugins/mcap/compression.h"

namespace runnel {

namespace {

constexpr std::size_t kMostIds = 65535;

}  // namespace

Result<std::unique_ptr<McapWriter>> McapWriter::Create(const std::string& file, McapWriterOptions options) {
  if (auto known = CheckCompression(options.compression); !known) return known.error();
  std::unique_ptr<McapWriter> writer(new McapWriter(file, std::move(options)));
  std::string start(kMcapMagic);
  AppendMcapRecord(McapOpcode::kHeader, start, [&](McapBytesWriter& bytes) {
    bytes.Text(writer->options_.header.profile).Text(writer->options_.header.library);
  });
  // All that needs memory is done: a file that is there is begun, or removed again.
  writer->descriptor_ = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (writer->descriptor_ < 0) {
    const int number = errno;
    return Error{.message = std::string("cannot be made: ") + std::strerror(number),
                 .position = {file},
                 .hint = number == EEXIST   ? "choose another name, or remove it"
                         : number == ENOENT ? "make its folder first"
                                            : ""};
  }
  if (auto written = writer->Write(start); !written) {
    unlink(file.c_str());
    return written.error();
  }
  return writer;
}

McapWriter::McapWriter(std::string file, McapWriterOptions options)
    : file_(std::move(file)), options_(std::move(options)) {}

McapWriter::~McapWriter() {
  if (descriptor_ >= 0) close(descriptor_);
}

Error McapWriter::Failure(const std::string& what, int number) {
  failure_ = {{.message = what + ": " + std::strerror(number),
               .position = {file_},
               .hint = "what was recorded until then, " + std::to_string(offset_) + " bytes, can be read"}};
  return failure_.front();
}

// All of it or nothing: what was written in part is cut off again.
Result<void> McapWriter::Write(std::string_view bytes) {
  if (!failure_.empty()) return failure_.front();
  for (std::string_view rest = bytes; !rest.empty();) {
    const ssize_t count = write(descriptor_, rest.data(), rest.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      const int number = count < 0 ? errno : EIO;
      Error error = Failure("cannot be written on", number);
      if (ftruncate(descriptor_, static_cast<off_t>(offset_)) != 0) {
        error.hint += "; the rest could not be cut off: " + std::string(std::strerror(errno));
      }
      return error;
    }
    rest.remove_prefix(static_cast<std::size_t>(count));
  }
  offset_ += bytes.size();
  checksum_.Add(bytes);
  return {};
}

template <typename WriteContent>
Result<void> McapWriter::WriteRecord(McapOpcode opcode, const WriteContent& write_content) {
  record_.clear();
  AppendMcapRecord(opcode, record_, write_content);
  return Write(record_);
}

Result<std::uint16_t> McapWriter::AddSchema(const std::string& name, const std::string& encoding,
                                            const std::string& data) {
  if (statistics_.schemas == kMostIds) {
    return Error{.message = "a file cannot have more than 65535 schemas", .position = {file_}};
  }
  const auto id = static_cast<std::uint16_t>(statistics_.schemas + 1);
  const auto written = WriteRecord(
      McapOpcode::kSchema, [&](McapBytesWriter& bytes) { bytes.Number(id).Text(name).Text(encoding).Text(data); });
  if (!written) return written.error();
  schemas_ += record_;
  ++statistics_.schemas;
  return id;
}

Result<std::uint16_t> McapWriter::AddChannel(std::uint16_t schema, const std::string& topic,
                                             const std::string& message_encoding, const McapTexts& metadata) {
  if (statistics_.channels == kMostIds) {
    return Error{
        .message = "a file cannot have more than 65535 channels", .position = {file_}, .hint = "record fewer ports"};
  }
  const auto id = static_cast<std::uint16_t>(statistics_.channels);
  const auto written = WriteRecord(McapOpcode::kChannel, [&](McapBytesWriter& bytes) {
    bytes.Number(id).Number(schema).Text(topic).Text(message_encoding).Texts(metadata);
  });
  if (!written) return written.error();
  channels_ += record_;
  ++statistics_.channels;
  statistics_.messages_of[id] = 0;
  return id;
}

Result<void> McapWriter::AddMessage(const McapMessage& message) {
  if (!failure_.empty()) return failure_.front();
  const auto count = statistics_.messages_of.find(message.channel);
  RUNNEL_CHECK(count != statistics_.messages_of.end(), "a message needs a channel of its file");
  chunk_start_ = chunk_.empty() ? message.log_time : std::min(chunk_start_, message.log_time);
  chunk_end_ = chunk_.empty() ? message.log_time : std::max(chunk_end_, message.log_time);
  record_.clear();
  AppendMcapRecord(McapOpcode::kMessage, record_,
                   [&](McapBytesWriter& bytes) { MessageHead(bytes, message).Bytes(message.data); });
  chunk_.reserve(chunk_.size() + record_.size());  // without memory it is neither here nor in the index
  index_[message.channel].push_back({message.log_time, chunk_.size()});
  chunk_ += record_;
  McapStatistics& all = statistics_;
  all.start = all.messages == 0 ? message.log_time : std::min(all.start, message.log_time);
  all.end = std::max(all.end, message.log_time);
  ++all.messages;
  ++count->second;
  return chunk_.size() >= options_.chunk_bytes ? WriteChunk() : Result<void>();
}

Result<void> McapWriter::AddAttachment(const McapAttachment& attachment) {
  const std::uint64_t offset = offset_;
  const auto written = WriteRecord(McapOpcode::kAttachment, [&](McapBytesWriter& bytes) {
    bytes.Number(attachment.log_time)
        .Number(attachment.create_time)
        .Text(attachment.name)
        .Text(attachment.media_type)
        .Number(static_cast<std::uint64_t>(attachment.data.size()))
        .Bytes(attachment.data);
    bytes.Number(ChecksumOf(std::string_view(record_).substr(kMcapRecordHead)));
  });
  if (!written) return written;
  AppendMcapRecord(McapOpcode::kAttachmentIndex, attachment_indexes_, [&](McapBytesWriter& bytes) {
    bytes.Number(offset)
        .Number(offset_ - offset)
        .Number(attachment.log_time)
        .Number(attachment.create_time)
        .Number(static_cast<std::uint64_t>(attachment.data.size()))
        .Text(attachment.name)
        .Text(attachment.media_type);
  });
  ++statistics_.attachments;
  return {};
}

Result<void> McapWriter::AddMetadata(const McapMetadata& metadata) {
  const std::uint64_t offset = offset_;
  const auto written = WriteRecord(McapOpcode::kMetadata,
                                   [&](McapBytesWriter& bytes) { bytes.Text(metadata.name).Texts(metadata.texts); });
  if (!written) return written;
  AppendMcapRecord(McapOpcode::kMetadataIndex, metadata_indexes_,
                   [&](McapBytesWriter& bytes) { bytes.Number(offset).Number(offset_ - offset).Text(metadata.name); });
  ++statistics_.metadata;
  return {};
}

// One index for each channel, behind the chunk that starts at offset_; `offsets` says where they will
// stand, as the chunk's own index has it.
void McapWriter::AppendMessageIndexes(std::string& bytes, std::string& offsets) const {
  McapBytesWriter offsets_writer(offsets);
  for (const auto& [channel, entries] : index_) {
    offsets_writer.Number(channel).Number(offset_ + bytes.size());
    AppendMcapRecord(McapOpcode::kMessageIndex, bytes, [&, id = channel, &all = entries](McapBytesWriter& writer) {
      writer.Number(id).Number(static_cast<std::uint32_t>(all.size() * 16));
      for (const IndexEntry& entry : all) writer.Number(entry.time).Number(entry.offset);
    });
  }
}

Result<void> McapWriter::WriteChunk() {
  if (auto compressed = Compress(options_.compression, chunk_, compressed_); !compressed) {
    failure_ = {compressed.error()};
    return compressed;
  }
  std::string bytes;
  bytes.reserve(compressed_.size() + 64);
  AppendMcapRecord(McapOpcode::kChunk, bytes, [&](McapBytesWriter& writer) {
    writer.Number(chunk_start_)
        .Number(chunk_end_)
        .Number(static_cast<std::uint64_t>(chunk_.size()))
        .Number(ChecksumOf(chunk_))
        .Text(options_.compression)
        .Number(static_cast<std::uint64_t>(compressed_.size()))
        .Bytes(compressed_);
  });
  const std::uint64_t chunk_length = bytes.size();
  std::string offsets;
  AppendMessageIndexes(bytes, offsets);
  record_.clear();
  AppendMcapRecord(McapOpcode::kChunkIndex, record_, [&](McapBytesWriter& writer) {
    writer.Number(chunk_start_)
        .Number(chunk_end_)
        .Number(offset_)
        .Number(chunk_length)
        .Text(offsets)
        .Number(bytes.size() - chunk_length)
        .Text(options_.compression)
        .Number(static_cast<std::uint64_t>(compressed_.size()))
        .Number(static_cast<std::uint64_t>(chunk_.size()));
  });
  chunk_indexes_.reserve(chunk_indexes_.size() + record_.size());  // what follows needs no memory
  // At one go, so that a file that was never finished ends behind a chunk.
  if (auto written = Write(bytes); !written) return written;
  chunk_indexes_ += record_;
  ++statistics_.chunks;
  chunk_.clear();
  index_.clear();
  return {};
}

std::string McapWriter::StatisticsRecord() const {
  std::string counts, record;
  McapBytesWriter counts_writer(counts);
  for (const auto& [id, count] : statistics_.messages_of) counts_writer.Number(id).Number(count);
  AppendMcapRecord(McapOpcode::kStatistics, record,
                   [&](McapBytesWriter& bytes) { StatisticsHead(bytes, statistics_).Text(counts); });
  return record;
}

void McapWriter::AppendSummaryGroup(McapOpcode opcode, const std::string& records, std::string& summary) {
  if (records.empty()) return;
  const std::uint64_t start = summary_start_ + summary.size();
  summary += records;
  AppendMcapRecord(McapOpcode::kSummaryOffset, summary_offsets_, [&](McapBytesWriter& bytes) {
    bytes.Number(static_cast<std::uint8_t>(opcode)).Number(start).Number(static_cast<std::uint64_t>(records.size()));
  });
}

Result<void> McapWriter::Finish() {
  if (is_finished_) return {};
  if (auto flushed = Flush(); !flushed) return flushed;
  std::string end;
  AppendMcapRecord(McapOpcode::kDataEnd, end, [&](McapBytesWriter& bytes) { bytes.Number(checksum_.value()); });
  summary_start_ = offset_ + end.size();
  std::string summary;
  AppendSummaryGroup(McapOpcode::kSchema, schemas_, summary);
  AppendSummaryGroup(McapOpcode::kChannel, channels_, summary);
  AppendSummaryGroup(McapOpcode::kStatistics, StatisticsRecord(), summary);
  AppendSummaryGroup(McapOpcode::kChunkIndex, chunk_indexes_, summary);
  AppendSummaryGroup(McapOpcode::kAttachmentIndex, attachment_indexes_, summary);
  AppendSummaryGroup(McapOpcode::kMetadataIndex, metadata_indexes_, summary);
  const std::uint64_t offsets_start = summary_start_ + summary.size();
  summary += summary_offsets_;
  McapBytesWriter(summary)
      .Number(static_cast<std::uint8_t>(McapOpcode::kFooter))
      .Number(kFooterLength)
      .Number(summary_start_)
      .Number(offsets_start);
  McapBytesWriter(summary).Number(ChecksumOf(summary)).Bytes(kMcapMagic);
  if (auto written = Write(end + summary); !written) return written;
  is_finished_ = true;
  const int closed = close(std::exchange(descriptor_, -1));
  if (closed != 0) return Failure("cannot be closed", errno);
  return {};
}

}  // namespace runnel
