#pragma once

#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "core/xml/xml_document.h"

namespace runnel::testing {

/// Application files that are right, nearly right, and not at all: those of a folder, changed. The
/// same seed and number give the same text, whatever has been made before.
class RandomFiles {
 public:
  RandomFiles(std::uint64_t seed, const std::filesystem::path& corpus);

  /// The first ones are the corpus as it is.
  [[nodiscard]] std::string Make(std::uint64_t number);
  [[nodiscard]] const std::vector<std::string>& corpus() const { return corpus_; }

 private:
  void NoteWords(XmlElement element);
  std::size_t Below(std::size_t count) { return random_() % count; }
  const std::string& OneOf(const std::vector<std::string>& texts) { return texts[Below(texts.size())]; }

  /// Changes one thing of a well-formed text: an element or an attribute of it.
  void ChangeMarkup(std::string& text, const XmlDocument& document);
  void ChangeElement(std::string& text, const std::vector<XmlElement>& elements);
  void ChangeAttribute(std::string& text, const std::vector<XmlElement>& elements);
  void Rename(std::string& text, XmlElement element);
  void Nest(std::string& text, TextSpan span);
  /// Changes bytes, of whatever text.
  void Damage(std::string& text);

  std::string Value();
  std::string Misspelt(std::string word);

  const std::uint64_t seed_;
  std::mt19937_64 random_;
  std::vector<std::string> corpus_;
  std::vector<std::string> tags_;
  std::vector<std::string> names_;   // of attributes
  std::vector<std::string> values_;  // of attributes
};

}  // namespace runnel::testing
