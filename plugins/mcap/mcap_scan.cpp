// The one way through a file when it is opened.
#include <algorithm>

#include "plugins/mcap/mcap_bytes.h"
#include "plugins/mcap/mcap_reader.h"

namespace runnel {

namespace {

// Loose messages are read so many bytes at a time.
constexpr std::uint64_t kStretch = 1 << 20;

// What anybody calls a compression is shorter.
constexpr std::uint64_t kLongestName = 256;

std::string Number(std::uint64_t number) { return std::to_string(number); }

}  // namespace

void McapReader::Scan() {
  std::uint64_t offset = kMcapMagic.size();
  Result<void> taken;
  bool is_first = true;
  while (taken && !contents_.ended_properly) {
    const auto head = ReadHead(offset);
    if (!head) {
      taken = head.error();
    } else {
      taken = is_first ? CheckHeader(*head) : Take(*head);
      offset = head->offset + head->length;
    }
    is_first = false;
  }
  if (!taken) contents_.damage = taken.error();
  if (!contents_.ended_properly || !has_statistics_) CountMessages();
  std::ranges::stable_sort(contents_.chunks, {}, &McapChunk::start);
}

Result<McapReader::Head> McapReader::ReadHead(std::uint64_t offset) {
  const auto bytes = file_->Look(offset, kMcapRecordHead);
  if (!bytes) return bytes.error();
  if (bytes->empty()) {
    return file_->ErrorAt(offset, "the file ends here, before its end was written");
  }
  McapBytesReader reader(*bytes);
  std::uint8_t opcode = 0;
  std::uint64_t length = 0;
  reader.Number(opcode).Number(length);
  if (reader.has_failed()) {
    return file_->ErrorAt(offset, "the file ends within the head of a record");
  }
  if (opcode == 0) return file_->ErrorAt(offset, "expected a record, found the opcode 0");
  const std::uint64_t content = offset + kMcapRecordHead;
  if (length > file_->size() - content) {
    return file_->ErrorAt(offset, "this record has " + Number(length) + " bytes, but the file ends " +
                                      Number(file_->size() - content) + " bytes after its head");
  }
  return Head{static_cast<McapOpcode>(opcode), content, length};
}

Result<void> McapReader::CheckHeader(const Head& head) {
  if (head.opcode == McapOpcode::kHeader) return Take(head);
  return file_->ErrorAt(head.offset - kMcapRecordHead, "expected the header (opcode 1), found opcode " +
                                                           Number(static_cast<std::uint8_t>(head.opcode)));
}

Result<std::string_view> McapReader::ReadContent(const Head& head, const char* what) {
  if (head.length > kLargest) {
    return file_->ErrorAt(head.offset - kMcapRecordHead, std::string(what) + " of " + Number(head.length) +
                                                             " bytes is larger than can be read, " + Number(kLargest));
  }
  if (head.length <= McapFile::kWindow) return file_->Look(head.offset, head.length);
  if (auto read = file_->Read(head.offset, head.length, buffer_); !read) return read.error();
  return std::string_view(buffer_);
}

Result<void> McapReader::Take(const Head& head) {
  switch (head.opcode) {
    case McapOpcode::kHeader:
    case McapOpcode::kSchema:
    case McapOpcode::kChannel:
    case McapOpcode::kMetadata:
    case McapOpcode::kStatistics: {
      const auto content = ReadContent(head, "a record");
      if (!content) return content.error();
      return TakeSmall(head.opcode, *content, head.offset - kMcapRecordHead);
    }
    case McapOpcode::kChunk:
      return TakeChunk(head);
    case McapOpcode::kAttachment:
      return TakeAttachment(head);
    case McapOpcode::kMessage:
      return TakeLooseMessage(head);
    case McapOpcode::kFooter:
      return TakeFooter(head);
    case McapOpcode::kDataEnd:
      has_data_end_ = true;
      return {};
    // By these others find what we find anyway.
    case McapOpcode::kMessageIndex:
    case McapOpcode::kChunkIndex:
    case McapOpcode::kAttachmentIndex:
    case McapOpcode::kMetadataIndex:
    case McapOpcode::kSummaryOffset:
      return {};
  }
  return {};  // of a later version, or private: to be passed over
}

Result<void> McapReader::TakeSmall(McapOpcode opcode, std::string_view content, std::uint64_t offset) {
  McapBytesReader bytes(content);
  const auto check = [&](const char* what) -> Result<void> {
    if (!bytes.has_failed()) return {};
    return file_->ErrorAt(offset,
                          std::string("expected ") + what + ", but what is in this record is longer than the record");
  };
  if (opcode == McapOpcode::kHeader) {
    bytes.Text(contents_.header.profile).Text(contents_.header.library);
    return check("a header");
  }
  if (opcode == McapOpcode::kSchema) {
    McapSchema schema;
    bytes.Number(schema.id).Text(schema.name).Text(schema.encoding).Text(schema.data);
    if (auto good = check("a schema"); !good) return good;
    if (schema.id != 0) contents_.schemas.try_emplace(schema.id, std::move(schema));
    return {};
  }
  if (opcode == McapOpcode::kChannel) {
    McapChannel channel;
    bytes.Number(channel.id)
        .Number(channel.schema)
        .Text(channel.topic)
        .Text(channel.message_encoding)
        .Texts(channel.metadata);
    if (auto good = check("a channel"); !good) return good;
    if (channel.schema != 0 && !contents_.schemas.contains(channel.schema)) {
      return file_->ErrorAt(offset, "the channel " + channel.topic + " has the schema " + Number(channel.schema) +
                                        ", which the file does not have before it");
    }
    contents_.channels.try_emplace(channel.id, std::move(channel));
    return {};
  }
  // The summary may repeat it.
  if (opcode == McapOpcode::kMetadata) {
    McapMetadata metadata;
    bytes.Text(metadata.name).Texts(metadata.texts);
    if (auto good = check("metadata"); !good) return good;
    contents_.metadata.push_back(std::move(metadata));
    return {};
  }
  McapStatistics& all = contents_.statistics;
  StatisticsHead(bytes, all);
  McapBytesReader counts(bytes.View());
  while (!counts.rest().empty() && !counts.has_failed()) {
    std::uint16_t channel = 0;
    std::uint64_t count = 0;
    counts.Number(channel).Number(count);
    all.messages_of[channel] = count;
  }
  has_statistics_ = !bytes.has_failed() && !counts.has_failed();
  return check("statistics");
}

Result<void> McapReader::TakeChunk(const Head& head) {
  constexpr std::uint64_t kMost = 8 + 8 + 8 + 4 + 4 + kLongestName + 8;
  const auto start = file_->Look(head.offset, std::min(kMost, head.length));
  if (!start) return start.error();
  McapChunk chunk;
  chunk.offset = head.offset - kMcapRecordHead;
  McapBytesReader bytes(*start);
  bytes.Number(chunk.start)
      .Number(chunk.end)
      .Number(chunk.size)
      .Number(chunk.checksum)
      .Text(chunk.compression)
      .Number(chunk.compressed_size);
  const std::uint64_t before = start->size() - bytes.rest().size();
  if (bytes.has_failed() || chunk.compressed_size > head.length - before) {
    return file_->ErrorAt(chunk.offset, "expected a chunk, but what is in this record is longer than the record");
  }
  if (chunk.size > kLargest || chunk.compressed_size > kLargest) {
    return file_->ErrorAt(chunk.offset, "a chunk of " + Number(std::max(chunk.size, chunk.compressed_size)) +
                                            " bytes is larger than can be read, " + Number(kLargest));
  }
  chunk.compressed_offset = head.offset + before;
  contents_.chunks.push_back(std::move(chunk));
  return {};
}

Result<void> McapReader::TakeAttachment(const Head& head) {
  const auto start = file_->Look(head.offset, std::min(McapFile::kWindow, head.length));
  if (!start) return start.error();
  McapAttachmentPlace place;
  McapBytesReader bytes(*start);
  bytes.Number(place.attachment.log_time)
      .Number(place.attachment.create_time)
      .Text(place.attachment.name)
      .Text(place.attachment.media_type)
      .Number(place.data_size);
  const std::uint64_t before = start->size() - bytes.rest().size();
  if (bytes.has_failed() || place.data_size > head.length - before) {
    return file_->ErrorAt(head.offset - kMcapRecordHead,
                          "expected an attachment, but what is in this record is longer than the record");
  }
  place.data_offset = head.offset + before;
  contents_.attachments.push_back(std::move(place));
  return {};
}

Result<void> McapReader::TakeLooseMessage(const Head& head) {
  const std::uint64_t offset = head.offset - kMcapRecordHead;
  const std::uint64_t length = head.length + kMcapRecordHead;
  if (length > kLargest) {
    return file_->ErrorAt(offset, "a message of " + Number(head.length) + " bytes is larger than can be read");
  }
  auto& chunks = contents_.chunks;
  if (!chunks.empty() && chunks.back().is_loose && chunks.back().offset + chunks.back().size == offset &&
      chunks.back().size + length <= kStretch) {
    chunks.back().size += length;
    chunks.back().compressed_size += length;
    return {};
  }
  McapChunk loose;
  loose.offset = loose.compressed_offset = offset;
  loose.size = loose.compressed_size = length;
  loose.end = ~std::uint64_t{0};
  loose.is_loose = true;
  chunks.push_back(std::move(loose));
  return {};
}

Result<void> McapReader::TakeFooter(const Head& head) {
  const std::uint64_t end = head.offset + head.length;
  const std::uint64_t at = head.offset - kMcapRecordHead;
  if (head.length < kFooterLength) {
    return file_->ErrorAt(
        at, "expected a footer of " + Number(kFooterLength) + " bytes, but it has " + Number(head.length));
  }
  if (!has_data_end_) return file_->ErrorAt(at, "expected the end of the data before the footer");
  const auto magic = file_->Look(end, kMcapMagic.size());
  if (!magic) return magic.error();
  if (*magic != kMcapMagic) {
    return file_->ErrorAt(end, "expected the bytes that MCAP files end with");
  }
  contents_.ended_properly = true;
  if (end + kMcapMagic.size() < file_->size()) {
    contents_.damage = file_->ErrorAt(end + kMcapMagic.size(), "expected the end of the file");
  }
  return {};
}

// What a file's writer has not told: what is in the chunks. Chunks behind one that is broken are not
// used: their channels may have been in it.
void McapReader::CountMessages() {
  McapStatistics counted;
  for (std::size_t i = 0; i < contents_.chunks.size(); ++i) {
    const McapStatistics before = counted;
    const auto read = ReadMessages(contents_.chunks[i], [&](const McapMessage& message) -> Result<void> {
      counted.start = counted.messages == 0 ? message.log_time : std::min(counted.start, message.log_time);
      counted.end = std::max(counted.end, message.log_time);
      ++counted.messages;
      ++counted.messages_of[message.channel];
      return {};
    });
    if (read) continue;
    contents_.damage = read.error();
    contents_.chunks.resize(i);
    counted = before;
  }
  counted.schemas = static_cast<std::uint16_t>(contents_.schemas.size());
  counted.channels = static_cast<std::uint32_t>(contents_.channels.size());
  counted.attachments = static_cast<std::uint32_t>(contents_.attachments.size());
  counted.metadata = static_cast<std::uint32_t>(contents_.metadata.size());
  counted.chunks = static_cast<std::uint32_t>(contents_.chunks.size());
  contents_.statistics = counted;
}

}  // namespace runnel
