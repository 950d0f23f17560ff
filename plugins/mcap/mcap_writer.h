#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "plugins/mcap/mcap_bytes.h"
#include "plugins/mcap/mcap_records.h"

namespace runnel {

struct McapWriterOptions {
  McapHeader header = {};
  std::string compression = {};       ///< see compression.h
  std::size_t chunk_bytes = 1 << 20;  ///< a chunk is written as soon as it has so many, uncompressed
};

/// Writes one MCAP file: chunks with their message indexes, and at the end a summary by which readers
/// find everything without going through the file. What has been flushed can be read by others also if
/// Finish() never comes: schemas and channels stand in front of the first message that needs them.
///
/// Threads:     one at a time. Allocates.
/// Ownership:   of the open file.
/// Errors:      with the file's name and what the system says. After one the file ends with the last
///              record that was written as a whole, and every further call gives the same error.
class McapWriter {
 public:
  /// Makes a new file. Errors: one is there already, its folder is not, no right to.
  static Result<std::unique_ptr<McapWriter>> Create(const std::string& file, McapWriterOptions options);
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// The id, given out in turn from 1 for schemas and from 0 for channels. Errors: 65535 are there.
  Result<std::uint16_t> AddSchema(const std::string& name, const std::string& encoding, const std::string& data);
  Result<std::uint16_t> AddChannel(std::uint16_t schema, const std::string& topic, const std::string& message_encoding,
                                   const McapTexts& metadata);
  /// Precondition: the message's channel is one of AddChannel().
  Result<void> AddMessage(const McapMessage& message);
  Result<void> AddAttachment(const McapAttachment& attachment);
  Result<void> AddMetadata(const McapMetadata& metadata);
  /// Ends the chunk that is being filled and gives it to the system.
  Result<void> Flush() { return chunk_.empty() ? Result<void>() : WriteChunk(); }
  /// Ends the chunk, writes the summary, and closes the file. Idempotent.
  Result<void> Finish();

  /// Precondition: as of AddMessage(). Those that have been given to the system so far.
  [[nodiscard]] std::uint64_t written_messages(std::uint16_t channel) const {
    const auto waiting = index_.find(channel);
    return statistics_.messages_of.at(channel) - (waiting == index_.end() ? 0 : waiting->second.size());
  }
  /// Bytes that have been given to the system so far.
  [[nodiscard]] std::uint64_t written_bytes() const noexcept { return offset_; }

 private:
  struct IndexEntry {
    std::uint64_t time;
    std::uint64_t offset;
  };

  McapWriter(std::string file, McapWriterOptions options);
  Result<void> Write(std::string_view bytes);
  template <typename WriteContent>
  Result<void> WriteRecord(McapOpcode opcode, const WriteContent& write_content);
  [[nodiscard]] Error Failure(const std::string& what, int number);
  Result<void> WriteChunk();
  void AppendMessageIndexes(std::string& bytes, std::string& offsets) const;
  void AppendSummaryGroup(McapOpcode opcode, const std::string& records, std::string& summary);
  [[nodiscard]] std::string StatisticsRecord() const;

  const std::string file_;
  const McapWriterOptions options_;
  int descriptor_ = -1;
  std::uint64_t offset_ = 0;
  Checksum checksum_;
  std::vector<Error> failure_;  // one or none
  bool is_finished_ = false;

  std::string chunk_;
  std::string compressed_;
  std::string record_;
  std::map<std::uint16_t, std::vector<IndexEntry>> index_;
  std::uint64_t chunk_start_ = 0;
  std::uint64_t chunk_end_ = 0;

  // Records for the summary, as they will stand there.
  std::string schemas_;
  std::string channels_;
  std::string chunk_indexes_;
  std::string attachment_indexes_;
  std::string metadata_indexes_;
  std::string summary_offsets_;
  std::uint64_t summary_start_ = 0;
  McapStatistics statistics_;
};

}  // namespace runnel
