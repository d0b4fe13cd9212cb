#!/usr/bin/env python3
"""Run the emitted WGSL of every gallery formula in Chromium, and compare its values with the gallery's tables.

usage: chromium.py [--pullback PROGRAM] [--chromium PROGRAM] [--rows N] [NAME...]

Chromium computes on its software adapter (SwiftShader), so no GPU is needed. A value may differ from the table by twice the
unit of single precision times the scale that the table states, the bound that the test of emitted C holds, too.
"""
import argparse
import html
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
UNIT = 2.0**-24
MOST = 2.0

PAGE = """<!doctype html><pre id="out">running</pre><script>
const jobs = JOBS;
async function run() {
  const adapter = await navigator.gpu.requestAdapter();
  const device = await adapter.requestDevice();
  const all = {};
  for (const job of jobs) {
    const module = device.createShaderModule({ code: job.code });
    const info = await module.getCompilationInfo();
    const errors = info.messages.filter((m) => m.type === 'error').map((m) => m.lineNum + ': ' + m.message);
    if (errors.length) { all[job.name] = { errors }; continue; }
    const pipeline = device.createComputePipeline({ layout: 'auto', compute: { module, entryPoint: 'check_main' } });
    const size = 16 * job.points.length;
    const make = (usage) => device.createBuffer({ size, usage });
    const points = make(GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST);
    const results = make(GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC);
    const read = make(GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST);
    device.queue.writeBuffer(points, 0, new Float32Array(job.points.flat()));
    const group = device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries: [
      { binding: 0, resource: { buffer: points } }, { binding: 1, resource: { buffer: results } }] });
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginComputePass();
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, group);
    pass.dispatchWorkgroups(Math.ceil(job.points.length / 64));
    pass.end();
    encoder.copyBufferToBuffer(results, 0, read, 0, size);
    device.queue.submit([encoder.finish()]);
    await read.mapAsync(GPUMapMode.READ);
    all[job.name] = { values: Array.from(new Float32Array(read.getMappedRange()), (v) => String(v)) };
  }
  return all;
}
run().then((all) => { document.getElementById('out').textContent = 'done ' + JSON.stringify(all); },
  (error) => { document.getElementById('out').textContent = 'failed ' + error; });
</script>"""

ENTRY = """
@group(0) @binding(0) var<storage, read> check_points: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> check_results: array<vec4f>;

@compute @workgroup_size(64)
fn check_main(@builtin(global_invocation_id) id: vec3u) {
    if id.x < arrayLength(&check_points) {
        let p = check_points[id.x];
        check_results[id.x] = vec4f(CALL);
    }
}
"""


def job(pullback, name, rows):
    """The code that evaluates a formula, its points, and what is expected there."""
    lines = (ROOT / f"tests/data/gallery/{name}.tsv").read_text().splitlines()[1:]
    columns = lines[0].lstrip("# ").split("\t")
    table = [line.split("\t") for line in lines[1:]]
    notes = lambda row: row[-1] if len(row) == len(columns) else ""
    table = [row for row in table if "coarse" not in notes(row) and "overflow" not in notes(row)][:rows]
    first = next(columns.index(c) for c in ("f", "f.re") if c in columns)
    width = 2 if columns[first] == "f.re" else 1
    scale = columns.index("scale_f")
    emit = [pullback, "emit", str(ROOT / f"docs/gallery/{name}.pull"), "--params", "constants", "-q"]
    code = subprocess.run(emit + ["--precision", "accurate"], check=True, capture_output=True, text=True).stdout
    function, arguments, result = re.findall(r"^fn (\w+)\((.*)\) -> (\w+) \{$", code, re.M)[-1]
    components, place = [], 0
    for argument in arguments.split(", "):
        of = argument.split(": ")[1]
        count = 1 if of == "f32" else int(of[3])
        if place >= first:
            components.append("0.0")  # the clock
        elif count == 1:
            components.append(f"p.{'xyzw'[place]}")
        else:
            components.append(f"p.{'xyzw'[place:place + count]}")
        place += count
    fill = {"f32": ", 0.0, 0.0, 0.0", "vec2f": ", 0.0, 0.0", "vec3f": ", 0.0"}[result]
    code += ENTRY.replace("CALL", f"{function}({', '.join(components)}){fill}")
    points = [[float(c) for c in row[:first]] + [0.0] * (4 - first) for row in table]
    expected = [([float(c) for c in row[first:first + width]], float(row[scale])) for row in table]
    return {"name": name, "code": code, "points": points}, expected


def judge(found, expected):
    """Violations, in words."""
    out = []
    for k, (values, scale) in enumerate(expected):
        got = [float(v) for v in found[4 * k:4 * k + len(values)]]
        if any(v != v or abs(v) > 1e38 for v in values):
            continue
        error = sum((g - v) ** 2 for g, v in zip(got, values)) ** 0.5
        if not error <= 2 * MOST * UNIT * scale * 1.001 + 1.2e-38:
            out.append(f"row {k}: {got} for {values}, scale {scale}")
    return out


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--pullback", default=str(ROOT / "target/release/pullback"))
    parser.add_argument("--chromium", default="chromium")
    parser.add_argument("--rows", type=int, default=200)
    parser.add_argument("names", nargs="*")
    options = parser.parse_args()
    names = options.names or sorted(p.stem for p in (ROOT / "docs/gallery").glob("*.pull"))
    jobs, expected = [], {}
    for name in names:
        one, values = job(options.pullback, name, options.rows)
        jobs.append(one)
        expected[name] = values
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder) / "page.html"
        page.write_text(PAGE.replace("JOBS", json.dumps(jobs).replace("</", "<\\/")))
        command = [options.chromium, "--headless", "--no-sandbox", "--enable-unsafe-webgpu",
                   "--use-webgpu-adapter=swiftshader", f"--user-data-dir={folder}/profile",
                   "--virtual-time-budget=600000", "--timeout=500000", "--dump-dom", page.as_uri()]
        shown = subprocess.run(command, capture_output=True, text=True, timeout=900).stdout
    text = html.unescape(re.search(r'<pre id="out">(.*?)</pre>', shown, re.S).group(1))
    if not text.startswith("done "):
        sys.exit(f"Chromium did not finish: {text[:500]}")
    results, wrong, rows = json.loads(text[5:]), 0, 0
    for name in names:
        result = results[name]
        problems = result.get("errors") or judge(result["values"], expected[name])
        rows += len(expected[name])
        wrong += bool(problems)
        for problem in problems[:5]:
            print(f"{name}: {problem}")
    print(f"{len(names)} formulas, {rows} rows, {wrong} formulas with violations")
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
