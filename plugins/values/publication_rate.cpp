#include "plugins/values/publication_rate.h"

namespace runnel {

namespace {

constexpr int kMostLooks = 3;   // at a port that publishes meanwhile
constexpr double kPeriods = 2;  // without a publication, and it publishes no more

}  // namespace

Publications Publications::Of(const Port& port) {
  Publications found;
  for (int looks = kMostLooks; looks > 0; --looks) {
    found.count = port.publications();
    port.VisitLatest([&](const void*, ValueTimes times) { found.newest = times.publication_time; });
    if (port.publications() == found.count) break;
  }
  return found;
}

double PublicationRate::Look(const Publications& publications, Time time) {
  if (publications.count < last_.count) last_ = {};  // the port was made anew
  if (!last_.newest) {
    rate_ = 0;
    last_ = publications;
  } else if (publications.count == last_.count) {
    if (rate_ == 0 || ToSeconds(time - *last_.newest) <= kPeriods / rate_) return rate_;
    rate_ = 0;
    last_ = {};
  } else if (publications.newest != last_.newest) {  // else more of one cycle
    const double seconds = ToSeconds(*publications.newest - *last_.newest);
    rate_ = seconds > 0 ? static_cast<double>(publications.count - last_.count) / seconds : 0;
    last_ = publications;
  }
  return rate_;
}

}  // namespace runnel
