#include "tests/core/lockfree/search.h"

#include <array>
#include <iostream>
#include <ostream>
#include <streambuf>
#include <string_view>

namespace runnel::test {
namespace {

/// What the search prints, in memory of its own: it has an operator new of its own too, and must not
/// be asked for memory while it reports. What does not fit is left out.
class SearchOutput : public std::streambuf {
 public:
  SearchOutput() { setp(text_.data(), text_.data() + text_.size()); }
  [[nodiscard]] std::string_view text() const { return {pbase(), static_cast<std::size_t>(pptr() - pbase())}; }

 private:
  int_type overflow(int_type) override { return 0; }
  std::array<char, 1 << 16> text_;
};

const SearchedSuite* searched = nullptr;

/// Any suite of so many threads, with fences of its own, which are there before it.
template <rl::thread_id_t kThreads>
struct AnySuite : SearchedFencesOf<kThreads>, rl::test_suite<AnySuite<kThreads>, kThreads> {
  AnySuite() { searched->construct(); }
  ~AnySuite() override { searched->destroy(); }
  void before() { searched->before(); }
  void thread(unsigned index) { searched->thread(index); }
  void after() { searched->after(); }
  void invariant() { searched->invariant(); }
};

bool Simulate(rl::thread_id_t thread_count, rl::test_params& parameters) {
  if (thread_count == 2) return rl::simulate<AnySuite<2>>(parameters);
  if (thread_count == 3) return rl::simulate<AnySuite<3>>(parameters);
  if (thread_count == 4) return rl::simulate<AnySuite<4>>(parameters);
  ADD_FAILURE() << "add a search of suites with " << thread_count << " threads";
  return false;
}

}  // namespace

rl::iteration_t CountPassed(const SearchedSuite& suite, rl::test_params parameters) {
  searched = &suite;
  parameters.progress_output_period = 1000000000;
  parameters.execution_depth_limit = 10000;
  const auto report = std::make_unique<SearchOutput>();
  std::ostream output(report.get());
  parameters.output_stream = &output;
  parameters.progress_stream = &output;
  if (Simulate(suite.thread_count, parameters)) return parameters.stop_iteration;
  std::cout << report->text() << std::endl;
  return 0;
}

}  // namespace runnel::test
