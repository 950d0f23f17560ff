# %% [markdown]
# # Which planner is the best?
# Variants of the Bug family in worlds made here, with noise, on all cores.

# %%
from runnel import arena

worlds = [arena.World(f"box_{width}", start=(-4, 0), goal=(4, 0)).box(0, 0.3, length=1, width=width) for width in (1, 3)]
table = arena.run(worlds, ["bug1", "bug2", "tangent_bug"], seeds=(1, 2), noise=0.01)
print(table)

# %%
try:
    frame = table.frame()
    print(frame.pivot_table("path_length_m", "variant", "world"))
except ImportError:
    print("pandas is not installed")

# %% [markdown]
# The same in two parts, as two machines would make them, put together.

# %%
for number in (1, 2):
    arena.run(worlds, ["bug2"], shard=(number, 2), json_file=f"part{number}.json")
print(len(arena.merge("all.json", "part1.json", "part2.json")), "runs")
