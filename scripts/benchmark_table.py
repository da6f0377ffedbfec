# SPDX-License-Identifier: MIT
"""Prints the figures as a table, beside the budgets."""
import math
import os
import pathlib
import re
import statistics
from typing import Any, Callable, Dict, List, Optional

# Budgets for a machine of 2 cores. For start and memory, a size has the budget of the next larger size that has one.
START_BUDGETS_S = {200: 1.0, 20_000: 3.0, 200_000: 10.0}
MEMORY_BUDGETS_MB = {200: 300.0, 20_000: 800.0, 200_000: 1500.0}
REAL_TIME_BUDGET = 30.0
LARGE_FIELD_SHARE = 0.8  # of the real-time factor with 200 plants, required with 100,000
CAMERA_REAL_TIME_BUDGET = 1.0
OF_SCENE_BUDGET, OF_FLAT_BUDGET = 0.8, 0.6
LEAST_SPEED_M_S = 0.45  # 0.5 is commanded; a robot that is held up would be timed at rest

Figures = Dict[str, Any]
Budget = Callable[[int, Figures], Optional[float]]


def of_size(budgets: Dict[int, float]) -> Budget:
    """Returns the budget of the size, or of the next larger one."""
    return lambda plants, _: next((b for n, b in sorted(budgets.items()) if n >= plants), None)


def fixed(budget: float) -> Budget:
    """Returns a budget that is the same for all sizes."""
    return lambda _plants, _: budget


def real_time_budget(plants: int, figures_of_smallest: Figures) -> Optional[float]:
    """Returns 30 up to 200 plants; beyond, 80 % of the smallest field's measured factor."""
    if plants <= 200:
        return REAL_TIME_BUDGET
    reached = value_at(figures_of_smallest, "node.real_time_factor")
    return LARGE_FIELD_SHARE * reached if reached else None


class Row:
    """One line of the table: label, path in the figures, format, and a budget above or below."""

    def __init__(
        self,
        text: str,
        path: str,
        form: str,
        most: Optional[Budget] = None,
        least: Optional[Budget] = None,
    ) -> None:
        self.text, self.path, self.form, self.most, self.least = text, path, form, most, least

    def cell(self, plants: int, figures: Figures, smallest: Figures) -> str:
        """Returns the figure, its budget, and a mark if it misses the budget."""
        value = value_at(figures, self.path)
        if value is None:
            return "-"
        text = self.form.format(value)
        for budget_of, sign, misses in (
            (self.most, "<=", lambda v, b: v > b),
            (self.least, ">=", lambda v, b: v < b),
        ):
            budget = budget_of(plants, smallest) if budget_of else None
            if budget is not None:
                mark = " !" if misses(value, budget) else "  "
                return f"{text} ({sign} {self.form.format(budget)}){mark}"
        return text + "  "


ROWS = [
    Row(
        "start to first scan, with ROS [s]", "node.start_s", "{:.2f}", most=of_size(START_BUDGETS_S)
    ),
    Row(
        "memory at first scan [MB]",
        "node.start_memory_mb",
        "{:.0f}",
        most=of_size(MEMORY_BUDGETS_MB),
    ),
    Row("memory after the drive [MB]", "node.memory_mb", "{:.0f}", most=of_size(MEMORY_BUDGETS_MB)),
    Row("start to first scan, engine alone [s]", "engine.start_s", "{:.2f}"),
    Row("step without readings, median [us]", "engine.nothing_read.step_us", "{:.0f}"),
    Row("step without readings, mean [us]", "engine.nothing_read.mean_step_us", "{:.0f}"),
    Row("a scan on top of it, median [us]", "engine.lidars.scan_us", "{:.0f}"),
    Row("a scan on top of it, 99th percentile [us]", "engine.lidars.scan_p99_us", "{:.0f}"),
    Row("lidar, a core [Mrays/s]", "lidar.mrays_per_s", "{:.2f}"),
    Row("bare Embree, the same scene, a core [Mrays/s]", "lidar.committed_mrays_per_s", "{:.2f}"),
    Row("bare Embree, its own triangles, a core [Mrays/s]", "lidar.embree_mrays_per_s", "{:.2f}"),
    Row("bare Embree, one flat BVH, a core [Mrays/s]", "lidar.flat_mrays_per_s", "{:.2f}"),
    Row(
        "lidar / bare Embree, the same scene",
        "lidar.of_committed",
        "{:.2f}",
        least=fixed(OF_SCENE_BUDGET),
    ),
    Row("lidar / bare Embree, its own triangles", "lidar.of_embree", "{:.2f}"),
    Row(
        "lidar / bare Embree, one flat BVH", "lidar.of_flat", "{:.2f}", least=fixed(OF_FLAT_BUDGET)
    ),
    Row("three cameras of 640x480 at 10 Hz [frames/s]", "camera.frames_per_s", "{:.1f}"),
    Row("their pixels, a core [M/s]", "camera.mpixels_per_s", "{:.2f}"),
    Row("bare Embree, a ray a pixel, a core [Mrays/s]", "camera.embree_mrays_per_s", "{:.2f}"),
    Row(
        "real-time factor with these cameras",
        "camera.real_time_factor",
        "{:.2f}",
        least=of_size({200: CAMERA_REAL_TIME_BUDGET}),
    ),
    Row("real-time factor, engine alone", "engine.all_but_pictures.real_time_factor", "{:.1f}"),
    Row("real-time factor, with ROS", "node.real_time_factor", "{:.1f}", least=real_time_budget),
    Row(
        "processor time a simulated second, engine alone [ms]",
        "engine.all_but_pictures.cpu_ms",
        "{:.1f}",
    ),
    Row("processor time a simulated second, with ROS [ms]", "node.cpu_ms", "{:.1f}"),
    Row("scans received a simulated second", "node.scans_per_simulated_s", "{:.1f}"),
    Row("speed driven [m/s]", "node.speed_m_s", "{:.2f}", least=fixed(LEAST_SPEED_M_S)),
]


def value_at(figures: Figures, path: str) -> Optional[float]:
    """Returns the figure at a dotted path, or None."""
    found = figures  # type: Any
    for key in path.split("."):
        found = found.get(key) if isinstance(found, dict) else None
    return found


def medians(repetitions: List[Figures]) -> Figures:
    """Returns the median of each figure over the repetitions."""
    keys = {key: None for figures in repetitions for key in figures}
    result = {}  # type: Figures
    for key in keys:
        values = [figures[key] for figures in repetitions if key in figures]
        nested = isinstance(values[0], dict)
        result[key] = medians(values) if nested else statistics.median(values)
    return result


def derive(figures: Figures) -> Figures:
    """Adds the figures that the table shows in other units."""
    lidar, node = figures.get("lidar", {}), figures.get("node", {})
    for name in ("rays_per_s", "committed_rays_per_s", "embree_rays_per_s", "flat_rays_per_s"):
        if name in lidar:
            lidar["m" + name if name == "rays_per_s" else name.replace("rays", "mrays")] = (
                lidar[name] / 1e6
            )
    camera = figures.get("camera", {})
    if camera:
        camera["mpixels_per_s"] = camera["pixels_per_cpu_s"] / 1e6
        camera["embree_mrays_per_s"] = camera["embree_rays_per_s"] / 1e6
    for part in (node, figures.get("engine", {}).get("all_but_pictures", {})):
        if "cpu_s_per_simulated_s" in part:
            part["cpu_ms"] = part["cpu_s_per_simulated_s"] * 1e3
    return figures


def machine() -> Dict[str, Any]:
    """Returns a description of the machine and of its other load."""
    cpu = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    memory = re.search(r"MemTotal:\s+(\d+)", pathlib.Path("/proc/meminfo").read_text())
    return {
        "cpu": cpu.group(1) if cpu else os.uname().machine,
        "cores": len(os.sched_getaffinity(0)),
        "memory_gb": round(int(memory.group(1)) * 1024 / 1e9, 1) if memory else math.nan,
        "system": f"{os.uname().sysname} {os.uname().release}",
        "load_at_start": os.getloadavg()[0],
    }


def header(about: Dict[str, Any], repeat: int) -> str:
    """Returns the lines above the table."""
    return (
        f"{about['cores']} cores of {about['cpu']}, {about['memory_gb']} GB, {about['system']}; "
        f"load before: {about['load_at_start']:.2f}\n"
        f"medians of {repeat}; in brackets the budget, ! misses it\n"
        "TerraSentia v1, lidar 1081 rays at 40 Hz, step 5 ms, 0.5 m/s down a row, as fast as the machine can\n"
    )


def table(results: Dict[int, Figures]) -> str:
    """Returns the table of all figures, one column per field size."""
    sizes = sorted(results)
    smallest = results[sizes[0]]
    lines = [["plants", *(f"{n:,}  " for n in sizes)]]
    for row in ROWS:
        cells = [row.cell(n, results[n], smallest) for n in sizes]
        if any(cell != "-" for cell in cells):
            lines.append([row.text, *cells])
    widths = [max(len(line[i]) for line in lines) for i in range(len(sizes) + 1)]
    return "\n".join(
        "  ".join([line[0].ljust(widths[0]), *(c.rjust(w) for c, w in zip(line[1:], widths[1:]))])
        for line in lines
    )
