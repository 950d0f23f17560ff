// What a test has begun ends in the opposite order: pages are closed before what they look at stops.

const stacks = new WeakMap();

export function Cleanup(t, end) {
  if (!stacks.has(t)) {
    const stack = [];
    stacks.set(t, stack);
    t.after(async () => {
      const faults = [];
      for (const each of stack.reverse()) await each().catch((error) => faults.push(error));
      if (faults.length > 0) throw faults[0];
    });
  }
  stacks.get(t).push(async () => end());
}
