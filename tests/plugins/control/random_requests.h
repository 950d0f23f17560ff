#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace runnel::test {

/// Requests that are right, nearly right, and not at all; the same ones for the same seed. Begins with
/// the corpus, file by file, and mixes it with what it makes.
class RandomRequests {
 public:
  RandomRequests(std::uint32_t seed, const std::filesystem::path& corpus) : random_(seed) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
      files.push_back(entry.path());
    }
    std::ranges::sort(files);
    for (const auto& file : files) {
      std::ifstream stream(file, std::ios::binary);
      corpus_.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    }
  }

  [[nodiscard]] std::size_t corpus_size() const { return corpus_.size(); }

  std::string Next() {
    if (given_ < corpus_.size()) return corpus_[given_++];
    std::string request = Below(3) == 0 ? corpus_[Below(corpus_.size())] : Made();
    for (std::size_t left = Below(4); left > 0; --left) Damage(request);
    return request;
  }

  /// Bytes as they might come over the socket: frames, and what is none.
  std::string NextBytes() {
    std::string payload = Next();
    std::string length = std::to_string(payload.size());
    if (Below(20) == 0) length = OneOf({"0", "-1", "1048577", "18446744073709551616", "x", ""});
    std::string bytes = (Below(20) == 0 ? OneOf({"reply", "", "Request", "end", "re quest"}) : std::string("request")) +
                        " " + length + "\n" + payload + "\n";
    if (Below(10) == 0) Damage(bytes);
    return bytes;
  }

  std::size_t Below(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }

 private:
  std::string OneOf(const std::vector<std::string>& texts) { return texts[Below(texts.size())]; }

  std::string Path() {
    return OneOf({"/a",
                  "/b",
                  "/c",
                  "/g",
                  "/g/x",
                  "/app",
                  "/",
                  "",
                  "a",
                  "/app/a",
                  "/app/c",
                  "..",
                  "/threads/main",
                  "/g/../a",
                  "//",
                  "/a/out",
                  "/b/in",
                  "/c/out",
                  "/g/p",
                  "/app/a/output/out",
                  "/app/b/input/in",
                  "/a/parameter/speed",
                  "/c/parameter/speed"});
  }
  std::string Type() {
    return OneOf({"test/counter", "test/sink", "test/failing", "test/nothing", "int32", "double", ""});
  }
  std::string Change() {
    switch (Below(10)) {
      case 0:
        return "create " + Path() + " " + Type() + OneOf({"", " speed=2", " speed=99", " x=1"});
      case 1:
        return "create group " + Path();
      case 2:
        return "create port " + Path() + OneOf({" input ", " output ", " "}) + Type();
      case 3:
        return "delete " + Path();
      case 4:
      case 5:
        return "connect " + Path() + " " + Path() +
               OneOf({"", " queue=3", " queue=3 on_full=refuse", " on_full=refuse", " queue=-1"});
      case 6:
        return "disconnect " + Path() + " " + Path();
      case 7:
        return "set " + Path() + " " + OneOf({"1", "-5", "nan", "\"\"", "{x: 1}", "[1, 2"});
      case 8:
        return "replace " + Path() + " with " + Type() + OneOf({"", " probation=0", " speed=3"});
      default:
        return "move " + Path() + " to " + OneOf({"main", "\"\"", "nobody", "/threads/main"});
    }
  }
  std::string Made() {
    switch (Below(12)) {
      case 0:
        return "ls " + Path() + OneOf({"", " long=yes"});
      case 1:
        return OneOf({"echo ", "hz "}) + Path() + OneOf({"", " count=2", " full=yes", " count=0"});
      case 2:
        return OneOf({"log", "log follow=yes", "paths", "types", "save", "save x", "lss", "pause", "resume", "step",
                      "step 3", "speed 2", "speed x", "undo", "redo", ""});
      default: {
        std::string text = "change" + OneOf({"", " file=f"}) + "\n";
        for (std::size_t left = 1 + Below(5); left > 0; --left) text += Change() + OneOf({"\n", "; "});
        return text;
      }
    }
  }
  void Damage(std::string& text) {
    static constexpr std::string_view kCharacters(
        " =\"\\;#[]{}\n\t/\x00\xff\xc3"
        "a0-",
        19);
    const std::size_t at = Below(text.size() + 1);
    switch (Below(5)) {
      case 0:
        text.insert(at, 1, kCharacters[Below(kCharacters.size())]);
        break;
      case 1:
        if (at < text.size()) text.erase(at, 1 + Below(4));
        break;
      case 2:
        if (at < text.size()) text[at] = static_cast<char>(Below(256));
        break;
      case 3:
        text.insert(at, text.substr(at / 2, Below(20)));
        break;
      default:
        text.resize(at);
    }
  }

  std::mt19937 random_;
  std::vector<std::string> corpus_;
  std::size_t given_ = 0;
};

}  // namespace runnel::test
