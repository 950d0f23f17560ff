#include "plugins/mcap/mcap_reader.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/check.h"
#include "plugins/mcap/compression.h"
#include "plugins/mcap/mcap_bytes.h"

namespace runnel {

Result<std::unique_ptr<McapFile>> McapFile::Open(const std::string& file) {
  const auto failure = [&](const std::string& why) {
    return Error{.message = "cannot be read: " + why, .position = {file}};
  };
  FileDescriptor found(open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (!found.is_open()) return failure(std::strerror(errno));
  struct stat state {};
  const int seen = fstat(found.number(), &state);
  const int number = errno;
  std::unique_ptr<McapFile> opened(new McapFile(file, std::move(found), static_cast<std::uint64_t>(state.st_size)));
  if (seen != 0) return failure(std::strerror(number));
  if (!S_ISREG(state.st_mode)) return failure("it is no file");
  return opened;
}

McapFile::McapFile(std::string name, FileDescriptor file, std::uint64_t size)
    : name_(std::move(name)), file_(std::move(file)), size_(size) {}

Error McapFile::ErrorAt(std::uint64_t offset, const std::string& message) const {
  return {.message = "at byte " + std::to_string(offset) + ": " + message, .position = {name_}};
}

Result<void> McapFile::Read(std::uint64_t offset, std::uint64_t count, std::string& bytes) {
  if (offset > size_ || count > size_ - offset) {
    return ErrorAt(offset,
                   "expected " + std::to_string(count) + " bytes, but the file ends at byte " + std::to_string(size_));
  }
  bytes.resize(count);
  for (std::uint64_t done = 0; done < count;) {
    const ssize_t read = pread(file_.number(), bytes.data() + done, count - done, static_cast<off_t>(offset + done));
    if (read < 0 && errno == EINTR) continue;
    if (read < 0) return ErrorAt(offset + done, std::strerror(errno));
    if (read == 0) return ErrorAt(offset + done, "the file has become shorter");
    done += static_cast<std::uint64_t>(read);
  }
  return {};
}

Result<std::string_view> McapFile::Look(std::uint64_t offset, std::uint64_t count) {
  RUNNEL_CHECK(count <= kWindow, "more is asked for than is read ahead");
  count = offset >= size_ ? 0 : std::min(count, size_ - offset);
  if (offset < window_offset_ || offset + count > window_offset_ + window_.size()) {
    const std::uint64_t ahead = offset >= size_ ? 0 : std::min(kWindow, size_ - offset);
    if (auto read = Read(offset, ahead, window_); !read) {
      window_.clear();
      return read.error();
    }
    window_offset_ = offset;
  }
  return std::string_view(window_).substr(offset - window_offset_, count);
}

namespace {

// "7f 45 4c 46 …", as a person compares it with what a file should begin with.
std::string Hexadecimal(std::string_view bytes) {
  return fmt::format("{:02x}", fmt::join(std::vector<unsigned char>(bytes.begin(), bytes.end()), " "));
}

}  // namespace

Result<std::unique_ptr<McapReader>> McapReader::Open(const std::string& file) {
  auto opened = McapFile::Open(file);
  if (!opened) return opened.error();
  std::unique_ptr<McapReader> reader(new McapReader(std::move(*opened)));
  const auto magic = reader->file_->Look(0, kMcapMagic.size());
  if (!magic) return magic.error();
  if (*magic != kMcapMagic) {
    return Error{.message = magic->empty() ? "this is no MCAP file: it is empty"
                                           : "this is no MCAP file: it begins with " + Hexadecimal(*magic) +
                                                 ", expected " + Hexadecimal(kMcapMagic),
                 .position = {file}};
  }
  reader->Scan();
  return reader;
}

const McapMetadata* McapReader::FindMetadata(std::string_view name) const {
  const auto found = std::ranges::find(contents_.metadata, name, &McapMetadata::name);
  return found == contents_.metadata.end() ? nullptr : &*found;
}

Error McapReader::ErrorIn(const McapChunk& chunk, std::uint64_t at, const std::string& message) const {
  if (chunk.is_loose) return file_->ErrorAt(chunk.offset + at, message);
  return file_->ErrorAt(chunk.offset, "in this chunk, uncompressed, at byte " + std::to_string(at) + ": " + message);
}

Result<std::string_view> McapReader::DecompressChunk(const McapChunk& chunk) {
  if (auto read = file_->Read(chunk.compressed_offset, chunk.compressed_size, compressed_); !read) {
    return read.error();
  }
  if (chunk.is_loose) return std::string_view(compressed_);
  if (auto uncompressed = Decompress(chunk.compression, compressed_, chunk.size, uncompressed_); !uncompressed) {
    Error error = file_->ErrorAt(chunk.offset, "in this chunk, " + uncompressed.error().message);
    error.hint = uncompressed.error().hint;
    return error;
  }
  const std::uint32_t checksum = chunk.checksum == 0 ? 0 : ChecksumOf(uncompressed_);
  if (checksum != chunk.checksum) {
    return file_->ErrorAt(chunk.offset, "the content of this chunk has the checksum " + std::to_string(checksum) +
                                            ", expected " + std::to_string(chunk.checksum));
  }
  return std::string_view(uncompressed_);
}

Result<void> McapReader::UseMessage(const McapChunk& chunk, std::string_view content, std::uint64_t at,
                                    const Use& use) {
  McapMessage message;
  McapBytesReader bytes(content);
  MessageHead(bytes, message);
  if (bytes.has_failed()) {
    return ErrorIn(chunk, at,
                   "expected a message, but this record has only " + std::to_string(content.size()) + " bytes");
  }
  if (!contents_.channels.contains(message.channel)) {
    return ErrorIn(
        chunk, at,
        "this message is of channel " + std::to_string(message.channel) + ", which the file does not have before it");
  }
  message.data = bytes.rest();
  return use(message);
}

Result<void> McapReader::ReadMessages(const McapChunk& chunk, const Use& use) {
  const auto uncompressed = DecompressChunk(chunk);
  if (!uncompressed) return uncompressed.error();
  std::string_view rest = *uncompressed;
  while (!rest.empty()) {
    const std::uint64_t at = uncompressed->size() - rest.size();
    McapBytesReader bytes(rest);
    std::uint8_t opcode = 0;
    const std::string_view content = bytes.Number(opcode).View<std::uint64_t>();
    if (bytes.has_failed()) return ErrorIn(chunk, at, "expected a record, but it is not whole");
    rest = bytes.rest();
    const auto kind = static_cast<McapOpcode>(opcode);
    Result<void> used;
    if (kind == McapOpcode::kMessage) {
      used = UseMessage(chunk, content, at, use);
    } else if (kind == McapOpcode::kSchema || kind == McapOpcode::kChannel) {
      used = TakeSmall(kind, content, chunk.offset);
    }
    if (!used) return used;
  }
  return {};
}

Result<void> McapReader::ReadMessages(const Use& use) {
  std::vector<McapChunk> chunks = contents_.chunks;
  std::ranges::stable_sort(chunks, {}, &McapChunk::offset);
  for (const McapChunk& chunk : chunks) {
    if (auto read = ReadMessages(chunk, use); !read) return read;
  }
  return {};
}

Result<std::string> McapReader::ReadAttachment(const McapAttachmentPlace& place) {
  if (place.data_size > kLargest) {
    return file_->ErrorAt(place.data_offset, "this attachment is larger than can be read");
  }
  std::string data;
  if (auto read = file_->Read(place.data_offset, place.data_size, data); !read) {
    return read.error();
  }
  return data;
}

}  // namespace runnel
