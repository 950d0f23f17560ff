#include "acpulse.h"

#include "pulse_c_types.h"

genom_event pulse_step(const pulse_wanted *wanted, double gain, double *level, const pulse_smooth *smooth,
                       const genom_context self)
{
  const pulse_types_number *now;
  wanted->read(self);
  now = wanted->data(self);
  if (now) *level += gain * (*now - *level);
  *smooth->data(self) = *level;
  smooth->write(self);
  return pulse_pause_start;
}

genom_event pulse_begin(double *gain, const genom_context self)
{
  (void)self;
  *gain = 0.1;
  return pulse_ether;
}

genom_event pulse_wait(const genom_context self)
{
  (void)self;
  return pulse_pause_start;
}
