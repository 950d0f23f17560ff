#include "core/plugin/plugin_entry.h"
#include "modules/places/place_book.h"
#include "modules/places/place_driver.h"
#include "modules/places/surveyor.h"

RUNNEL_PLUGIN(places, registry) {
  using namespace runnel::places;
  registry.Add<PlaceBook>("places/book", "remembers where the robot was, by names: remember, where, names");
  registry.Add<Surveyor>("places/surveyor", "notes places where the robot comes by, on the book's blackboard");
  registry.Add<PlaceDriver>("places/driver", "has the robot drive to a place when it is asked to: go");
}
