#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/file_descriptor.h"
#include "core/base/result.h"
#include "plugins/mcap/mcap_records.h"

namespace runnel {

/// A file that is read at any place. What another process adds to it meanwhile is not seen.
///
/// Threads: one at a time.
class McapFile {
 public:
  /// Errors: it is not there, may not be read, or is no file.
  static Result<std::unique_ptr<McapFile>> Open(const std::string& file);

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }

  /// Replaces `bytes` by `count` bytes from `offset` on. Errors: the file has no more so many.
  Result<void> Read(std::uint64_t offset, std::uint64_t count, std::string& bytes);
  /// At most `count` bytes from `offset` on, fewer only at the end; valid until the next call. Reads
  /// ahead. Precondition: count <= kWindow.
  Result<std::string_view> Look(std::uint64_t offset, std::uint64_t count);
  static constexpr std::uint64_t kWindow = 1 << 16;

  /// "at byte 120: …", in this file.
  [[nodiscard]] Error ErrorAt(std::uint64_t offset, const std::string& message) const;

 private:
  McapFile(std::string name, FileDescriptor file, std::uint64_t size);

  const std::string name_;
  const FileDescriptor file_;
  const std::uint64_t size_;
  std::string window_;
  std::uint64_t window_offset_ = 0;
};

/// Where a file has messages: a chunk, or a stretch of messages that are in none.
struct McapChunk {
  std::uint64_t offset = 0;  ///< of its record, or of the first message's
  std::uint64_t start = 0;   ///< of the times of its messages; loose ones: of any time
  std::uint64_t end = 0;
  std::string compression = {};
  std::uint64_t compressed_offset = 0;
  std::uint64_t compressed_size = 0;
  std::uint64_t size = 0;
  std::uint32_t checksum = 0;  ///< 0: none
  bool is_loose = false;
};

/// Where a file has an attachment.
struct McapAttachmentPlace {
  McapAttachment attachment;  ///< without its data
  std::uint64_t data_offset = 0;
  std::uint64_t data_size = 0;
};

/// What a file has, but for the messages themselves.
struct McapContents {
  McapHeader header;
  std::map<std::uint16_t, McapSchema> schemas;
  std::map<std::uint16_t, McapChannel> channels;
  std::vector<McapMetadata> metadata;
  std::vector<McapAttachmentPlace> attachments;
  std::vector<McapChunk> chunks;  ///< by `start`
  /// As its writer has it or, where it has not come to write it, counted.
  McapStatistics statistics;
  /// It has all that its writer wanted to write.
  bool ended_properly = false;
  /// Where the file ceases to be what it should be, and why; what comes before can be read.
  std::optional<Error> damage;
};

/// Reads MCAP files, those also that were never finished, and those of others. Goes through the records
/// once when it opens a file, past the contents of chunks; of a file without an end, or without
/// statistics, it reads those too.
///
/// Threads:  one at a time. Allocates; never more than kLargest for one record or chunk, whatever the
///           file says.
/// Errors:   say at which byte, and what was expected.
class McapReader {
 public:
  /// Errors: no MCAP file from its first bytes on. What is broken further on is McapContents::damage.
  static Result<std::unique_ptr<McapReader>> Open(const std::string& file);

  [[nodiscard]] const std::string& file() const noexcept { return file_->name(); }
  [[nodiscard]] std::uint64_t size() const noexcept { return file_->size(); }
  [[nodiscard]] const McapContents& contents() const noexcept { return contents_; }
  [[nodiscard]] const McapMetadata* FindMetadata(std::string_view name) const;

  /// Calls `use` for each message of the chunk, in the order of the file. The data are valid until it
  /// returns; an error of `use` ends it. Errors: what is compressed is broken, a wrong checksum, a message
  /// of an unknown channel.
  using Use = std::function<Result<void>(const McapMessage& message)>;
  Result<void> ReadMessages(const McapChunk& chunk, const Use& use);
  /// The same for all chunks, in the order of the file. They overlap in time where a writer has taken what waited channel by
  /// channel; the messages of one channel come as they were written.
  Result<void> ReadMessages(const Use& use);
  [[nodiscard]] Result<std::string> ReadAttachment(const McapAttachmentPlace& place);

  static constexpr std::uint64_t kLargest = 256u << 20;

 private:
  explicit McapReader(std::unique_ptr<McapFile> file) : file_(std::move(file)) {}

  struct Head {
    McapOpcode opcode;
    std::uint64_t offset;  // of the content
    std::uint64_t length;
  };
  // mcap_scan.cpp
  void Scan();
  Result<Head> ReadHead(std::uint64_t offset);
  Result<void> Take(const Head& head);
  Result<void> TakeChunk(const Head& head);
  Result<void> TakeAttachment(const Head& head);
  Result<void> TakeLooseMessage(const Head& head);
  Result<void> TakeFooter(const Head& head);
  Result<void> TakeSmall(McapOpcode opcode, std::string_view content, std::uint64_t offset);
  Result<void> CheckHeader(const Head& head);
  Result<std::string_view> ReadContent(const Head& head, const char* what);
  void CountMessages();

  // Where an error was: in the file, or in the uncompressed content of a chunk.
  [[nodiscard]] Error ErrorIn(const McapChunk& chunk, std::uint64_t at, const std::string& message) const;
  Result<std::string_view> DecompressChunk(const McapChunk& chunk);
  Result<void> UseMessage(const McapChunk& chunk, std::string_view content, std::uint64_t at, const Use& use);

  const std::unique_ptr<McapFile> file_;
  McapContents contents_;
  bool has_statistics_ = false;
  bool has_data_end_ = false;
  std::string buffer_;
  std::string compressed_;
  std::string uncompressed_;
};

}  // namespace runnel
