#include "achop.h"

#include "hop_c_types.h"

genom_event hop_start_codel(double *level, const genom_context self)
{
  (void)self;
  *level = 1;
  return hop_pause_sink;
}

genom_event hop_sink_codel(double *level, const genom_context self)
{
  (void)self;
  *level *= 0.9;
  return hop_pause_sink;
}

genom_event hop_check(double by, const genom_context self)
{
  const hop_high_detail detail = {10};
  return by <= detail.most ? genom_ok : hop_high(&detail, self);
}

genom_event hop_lift(double by, double *level, const genom_context self)
{
  (void)self;
  *level += by;
  return genom_ok;
}
