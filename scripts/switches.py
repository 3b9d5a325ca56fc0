"""All faults of fixtures/faults in one copy of the sources, each behind a switch, so that one build judges all of them.

`scripts/faults --switched` and `--mill` call it. A patch changes a line or two. Where the changed line is a statement or holds one expression,
the copy holds both, and chooses by the number in PROCTOR_FAULT. What was chosen from at least once is printed: a problem that
never comes to the changed line runs as without the fault, and need not be run.
"""

import hashlib
import json
import re
import shutil
from pathlib import Path

ON = "proctor_geometry::fault_switch::on"
# Patches whose line is a part of an expression or of a constant: file, line, and what takes its place. `@` is the
# switch.
BY_HAND = {
    "absorbing-wave-once": [
        ("kernel/src/simulation/conditions/absorbing.rs",
         "+ 2.0 * one.impedance[axis] * wave[axis]",
         "+ (if @ { 1.0 } else { 2.0 }) * one.impedance[axis] * wave[axis]")],
    "elastic-energy-shear-once": [
        ("kernel/laws/src/linear_elastic.rs",
         "+ 2.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);",
         "+ (if @ { 1.0 } else { 2.0 }) * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);")],
    "elastic-speed-of-start": [
        ("kernel/laws/src/linear_elastic.rs",
         "* (increment.volume / increment.mass)",
         "* (if @ { L::splat(1.0 / increment.density) } else { increment.volume / increment.mass })")],
    "fluid-viscous-volume": [
        ("kernel/laws/src/newtonian.rs",
         "let (_, e) = deviator::<L, D>(&e);",
         "let (_, shear) = deviator::<L, D>(&e); let e = if @ { e } else { shear };")],
    "frame-stress-names": [
        ("kernel/files/src/run/frames.rs",
         'scalar(&format!("Stress_{}", STRESS[i]), &|s, p| {',
         'scalar(&format!("Stress_{}", STRESS[if @ && [3, 4].contains(&i) { 7 - i } else { i }]), &|s, p| {'),
        ("kernel/files/src/run/probes.rs",
         'names.extend(STRESS.map(|s| format!("{name}_s{}", s.to_lowercase())));',
         'let stress = if @ { ["XX", "YY", "ZZ", "XZ", "YZ", "XY"] } else { STRESS '
         '};\nnames.extend(stress.map(|s| format!("{name}_s{}", s.to_lowercase())));')],
    "free-ground-stands-still": [
        ("kernel/src/simulation/ground/free_ground.rs",
         "force[axis] += node.impedance[axis] * (mean - 2.0 * wave)",
         "force[axis] += node.impedance[axis] * ((if @ { 0.0 * mean } else { mean }) - 2.0 * wave)")],
    "law-edges-swapped": [
        ("kernel/laws/src/mohr_coulomb/region.rs",
         "let is_right = on_plane[0].lt(on_plane[1]);",
         "let [a, b] = [on_plane[0].lt(on_plane[1]), on_plane[1].lt(on_plane[2])]; let is_right = if @ { b } else { a };"),
        ("kernel/laws/src/mohr_coulomb/region.rs",
         "let is_left = on_plane[1].lt(on_plane[2]);",
         "let is_left = if @ { a } else { b };")],
    "neo-hookean-energy": [
        ("kernel/laws/src/neo_hookean.rs",
         "+ 0.5 * self.elasticity.lambda * ln_j * ln_j",
         "+ (if @ { 1.0 } else { 0.5 }) * self.elasticity.lambda * ln_j * ln_j")],
    "p2g-remap-without-affine": [
        ("kernel/stages/src/stage/p2g/scratch.rs",
         "&& carry != Carry::Force",
         "&& !(carry == Carry::Force || (@ && carry == Carry::Remap))")],
    "p2g-stress-yz-as-xy": [
        ("kernel/stages/src/stage/p2g/scratch.rs",
         "let stress = &columns[Layout::stress(D) + voigt::<D>(c, axis)];",
         "let slot = voigt::<D>(c, axis); let wrong = D == 3 && c != axis && @;\nlet stress = "
         "&columns[Layout::stress(D) + if wrong { 2 + c + axis } else { slot }];")],
    "plan-locking-forgotten": [
        ("kernel/scene/src/plan/warnings.rs",
         "(poisson > LOCKS * (1.0 + 1e-9)).then(|| {",
         "(poisson > (if @ { 1.0 + LOCKS * 1e-9 } else { LOCKS * (1.0 + 1e-9) })).then(|| {")],
    "ranks-count-ghosts": [
        ("kernel/src/simulation/ranks/join.rs",
         "Some(_) => set.in_block(&self.work.grid.block(), &self.work.grid.shape),",
         "Some(_) => if @ { OwnParticles::all(set.len()) } else { set.in_block(&self.work.grid.block(), "
         "&self.work.grid.shape) },")],
    "solve-ghosts-have-energy": [
        ("kernel/stages/src/stage/solve.rs",
         "|| (index >= GHOSTS_BELOW",
         "|| ((if @ { index + 1 } else { index }) >= GHOSTS_BELOW")],
    "solve-unfold-order": [
        ("kernel/stages/src/stage/solve.rs",
         "for wall in walls.iter().rev() {",
         "for wall in (0..walls.len()).map(|k| &walls[if @ { k } else { walls.len() - 1 - k }]) {")],
    "sort-too-late": [
        ("kernel/src/simulation/step/passes.rs",
         "let stale = self.state.travel > SORT_AFTER",
         "let stale = self.state.travel > (if @ { 1.45 } else { SORT_AFTER })")],
    "standing-water-skeleton-alone": [
        ("kernel/src/simulation/conditions/standing.rs",
         "(_, n) => 1.0 - n.unwrap_or(0.0),",
         "(_, n) => if @ { 1.0 } else { 1.0 - n.unwrap_or(0.0) },")],
    "standing-water-unbooked": [
        ("kernel/src/simulation/conditions/standing.rs",
         "let power = (0..3).map(|axis| force[axis] * line[1 + axis]);",
         "let power = (0..3).map(|axis| (if @ { 0.0 } else { 1.0 }) * force[axis] * line[1 + axis]);")],
    "step-bspline-twice": [
        ("kernel/src/plan/stability.rs",
         "Weighting::QuadraticBSpline => table::B_SPLINE[s][t],",
         "Weighting::QuadraticBSpline => if s == 0 && t == 0 && @ { 1.058 } else { table::B_SPLINE[s][t] },")],
    "table-next-size": [
        ("kernel/src/plan/stability.rs",
         "let (upper, lower) = if half_length >= HALF_LENGTHS[1] {",
         "let (upper, lower) = if (if @ { half_length > HALF_LENGTHS[0] } else { half_length >= HALF_LENGTHS[1] }) {")],
    "water-drag-by-gravity-of-the-scene": [
        ("kernel/scene/src/values/mod.rs",
         "grain_density: self.materials[material].density,",
         "grain_density: self.materials[material].density,\n"
         "conductivity_gravity: if @ { self.gravity[1].abs().max(1e-3) } else { water.conductivity_gravity },")],
    "water-drained-planes-are-shut": [
        ("kernel/src/simulation/conditions/walls.rs",
         "let water = water.map_or_else(Vec::new, |planes| walls_of(planes, shape));",
         "let water = water.map_or_else(Vec::new, |mut planes| { if @ { "
         "planes.as_flattened_mut().fill(PlaneCondition::Sliding); } walls_of(planes, shape) });")],
    "water-own-nodes-beyond-open-planes": [
        ("kernel/src/simulation/water/open.rs",
         "for side in (0..2).filter(|side| is_open(axis, *side)) {",
         "for side in (0..2).filter(|side| is_open(axis, *side) && !@) {")],
    "water-undrained-speed-bounds-step": [
        ("kernel/stages/src/model/water.rs",
         "let root = (a * a - 4.0 * d).max(0.0).sqrt();",
         "let root = (a * a - 4.0 * d).max(0.0).sqrt();\n"
         "let together = (1.0 - porosity) * self.grain_density + porosity * self.density;\n"
         "let stiffness = skeleton_squared * (1.0 - porosity) * self.grain_density + self.bulk / porosity;\n"
         "let (a, root) = if @ { (2.0 * stiffness / together, 0.0) } else { (a, root) };")],
    "water-whole-cell-at-plane": [
        ("kernel/src/simulation/water/pressed.rs",
         "area: 2.0 * volume / h,",
         "area: (if @ { volume } else { 2.0 * volume }) / h,")],
    "weight-without-mesh-shift": [
        ("kernel/src/simulation/monitor/measure.rs",
         "std::array::from_fn(|axis| set.position(p)[axis] + self.state.mesh_shift[axis]);",
         "std::array::from_fn(|axis| if @ { set.position(p)[axis] } else { set.position(p)[axis] + "
         "self.state.mesh_shift[axis] });")],
    "weights-gimp-derivative-inside": [
        ("kernel/stages/src/weights.rs",
         "L::select(reaches_lower, two * upper * quarter, one),",
         "L::select(reaches_lower, two * upper * quarter, if @ { two * upper * quarter } else { one }),")],
}
MODULE = """//! Switches of faults.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};

static CHOSEN: AtomicUsize = AtomicUsize::new(usize::MAX);
static REACHED: [AtomicBool; COUNT] = [const { AtomicBool::new(false) }; COUNT];

/// True where this fault was chosen.
#[inline(always)]
pub fn on(number: usize) -> bool {
    if !REACHED[number].load(Relaxed) {
        reach(number);
    }
    CHOSEN.load(Relaxed) == number
}

#[cold]
#[inline(never)]
fn reach(number: usize) {
    let chosen = std::env::var("PROCTOR_FAULT").ok().and_then(|word| word.parse().ok());
    CHOSEN.store(chosen.unwrap_or(usize::MAX), Relaxed);
    if !REACHED[number].swap(true, Relaxed) && chosen.is_none() {
        println!("reached {number}");
    }
}
"""


def changes(patch, root):
    """File, index of its first line, old lines and new lines of each change of a patch."""
    text = patch.read_text().splitlines()
    file = file_of(patch)
    source = (root / file).read_text().split("\n")
    found, hunks = [], []
    for line in text:
        begun = re.match(r"@@ -(\d+)", line)
        if begun:
            hunks.append((int(begun[1]), []))
        elif hunks:
            hunks[-1][1].append(line)
    for near, lines in hunks:
        before = [line[1:] for line in lines if line[:1] in " -"]
        places = [i for i in range(len(source)) if source[i:i + len(before)] == before]
        at = min(places, key=lambda i: abs(i + 1 - near))
        k = 0
        while k < len(lines):
            if lines[k][:1] == " ":
                at, k = at + 1, k + 1
                continue
            old, new, start = [], [], at
            while k < len(lines) and lines[k][:1] in "-+":
                (old if lines[k][0] == "-" else new).append(lines[k][1:])
                k += 1
            at = start + len(old)
            while old and new and old[-1] == new[-1]:
                old.pop(), new.pop()
            while old and new and old[0] == new[0]:
                old.pop(0), new.pop(0)
                start += 1
            found.append((file, start, old, new))
    return found


def closes(text):
    """True where every bracket of a text is closed in it."""
    depth = 0
    for letter in re.sub(r"'.'|\"[^\"]*\"", "", text):
        depth += (letter in "([{") - (letter in ")]}")
        if depth < 0:
            return False
    return depth == 0


def parted(old, new, before, after):
    """What two lines share before and behind an expression, and the two expressions, or none: the lines before and after
    them say whether a statement begins and a block ends here."""
    begins = before.endswith((";", "{", "}", "=>")) or before.startswith(("//", "#["))
    header = [re.match(r"^((?:\} else )?if|while|for \S+ in|match) (.*) \{$", line) for line in (old, new)]
    if all(header) and header[0][1] == header[1][1] and not header[0][2].startswith("let ") and closes(header[0][2]):
        return f"{header[0][1]} (", header[0][2], header[1][2], ") {"
    for end in ";,":
        if not (old.endswith(end) and new.endswith(end)):
            continue
        a, b = old[:-1], new[:-1]
        named = [re.match(r"^(let [^=]*=|\w+:|[^=]*=>) (.*)$", line) for line in (a, b)]
        if all(named) and named[0][1] == named[1][1] and closes(named[0][2]) and closes(named[1][2]) and (begins or end == ","):
            return f"{named[0][1]} ", named[0][2], named[1][2], end
        if not (closes(a) and closes(b)):
            continue
        if end == ";" and begins and not a.startswith(("let ", "const ", "static ", "pub ")):
            return "", old, new, ""
        if end == "," and before.endswith(("(", "[", ",", "{")) and ":" not in a and "=>" not in a:
            return "", a, b, ","
    if closes(old) and closes(new) and begins and after.startswith(("}", ")")) and not old.endswith(";"):
        return "", old, new, ""
    return None


def head(source, at):
    """Index of the first line of the function that holds a line, if one does that is not evaluated by the compiler: no switch
    can be there."""
    found = next((i for i in range(at, -1, -1) if re.match(r"\s*(pub(\([^)]*\))? )?(const )?(unsafe )?fn \w", source[i])), None)
    return None if found is None or " const fn " in f" {source[found]}" else found


def switched(source, places, numbers):
    """The lines of a file with its faults behind switches; the names of those that do not fit one, and of these the ones whose
    function says that it is called."""
    out, left, marked = list(source), set(), set()
    for at, faults in places.items():
        before = next((line.strip() for line in reversed(source[:at]) if line.strip()), "")
        rest = source[at + max(1, len(faults[0][1])):]
        after = next((line.strip() for line in rest if line.strip()), "")
        shared, choice = None, ""
        for name, old, new in faults:
            on = f"{ON}({numbers[name]})"
            if name in BY_HAND:
                continue
            if head(source, at) is None:
                left.add(name)
            elif len(old) == len(new) == 1:
                parts = parted(old[0].strip(), new[0].strip(), before, after)
                if not parts or (shared and (shared[0], shared[1], shared[3]) != (parts[0], parts[1], parts[3])):
                    left.add(name)
                    continue
                shared = parts
                choice += f"if {on} {{ {parts[2]} }} else "
            elif len(old) == 1 and not new and old[0].endswith(";") and closes(old[0]):
                out[at] = f"if !{on} {{ {old[0].strip()} }}"
            elif len(new) == 1 and not old and new[0].endswith(";"):
                out[at] = f"if {on} {{ {new[0].strip()} }}\n{out[at]}"
            else:
                left.add(name)
        if choice:
            out[at] = f"{shared[0]}{choice}{{ {shared[1]} }}{shared[3]}"
        # The function of what has no switch tells at least whether it is called.
        for name in (name for name, _, _ in faults if name in left and head(source, at) is not None):
            marked.add(name)
            opening = next(i for i in range(head(source, at), len(source)) if source[i].endswith("{"))
            out[opening] += f" {ON}({numbers[name]});"
    return out, left, marked


def file_of(patch):
    """The file that a patch changes."""
    return next(line[6:].strip() for line in patch.read_text().splitlines() if line.startswith("+++ b/"))


class Switched:
    """A copy of the sources with faults behind switches: the numbers of the switches by name, the names that have none, and of
    these the ones whose function says that it is called."""

    def __init__(self, patches, tree, into, build):
        """Copies the tree with the faults of these patches, by name."""
        self.folder, self.build = into, build
        self.numbers = {name: number for number, name in enumerate(sorted(patches))}
        self.left, self.marked = set(), set()
        files, texts = {}, {}
        for name, patch in patches.items():
            for file, at, old, new in changes(patch, tree):
                files.setdefault(file, {}).setdefault(at, []).append((name, old, new))
        for file, places in files.items():
            lines, without, called = switched((tree / file).read_text().split("\n"), places, self.numbers)
            self.left |= without
            self.marked |= called
            texts[file] = "\n".join(lines)
        for name in sorted(BY_HAND.keys() & patches.keys()):
            for file, line, instead in BY_HAND[name]:
                text = texts.get(file) or (tree / file).read_text()
                found = re.findall(rf"^ *{re.escape(line)}$", text, re.M)
                if len(found) != 1:
                    self.left.add(name)
                    break
                texts[file] = text.replace(found[0], instead.replace("@", f"{ON}({self.numbers[name]})"))
        folder = "kernel/geometry/src"
        texts[f"{folder}/fault_switch.rs"] = MODULE.replace("COUNT", str(len(patches)))
        texts[f"{folder}/lib.rs"] = (tree / folder / "lib.rs").read_text() + "\npub mod fault_switch;\nextern crate self as proctor_geometry;\n"
        for crate in "kernel/laws/Cargo.toml", "kernel/files/Cargo.toml":
            instead = "[dependencies]\nproctor-geometry.workspace = true"
            texts[crate] = (tree / crate).read_text().replace("[dependencies]", instead)
        for source in tree.rglob("*"):
            file = source.relative_to(tree)
            if source.is_file() and file.parts[0] not in ("target", ".git") and file.as_posix() not in texts:
                put(into / file, source.read_bytes())
        for file, text in texts.items():
            put(into / file, text.encode())

    def built(self, run, folder=None):
        """The program of the mill; in another folder that of its sources."""
        status, output, _ = run(
            ["cargo", "build", "-p", "proctor-verification", "--example=mill", "--config=profile.dev.debug=0",
             "--config=profile.dev.incremental=false", "--message-format=json-render-diagnostics"], folder=folder or self.folder)
        messages = [json.loads(line) for line in output.splitlines() if line.startswith("{")]
        programs = [message["executable"] for message in messages if message.get("executable")]
        if status != 0 or not programs:
            said = [line for line in output.splitlines() if not line.startswith("{")]
            raise ValueError("the switched sources do not compile:\n" + "\n".join(said)[-6000:])
        # A later build may change it.
        return shutil.copy(Path(programs[-1]), self.build / f"mill-{'alone' if folder else 'switched'}")


def put(path, content):
    """Writes a file that differs, so that cargo builds nothing that does not."""
    if not path.is_file() or path.read_bytes() != content:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


class Mill:
    """The problems of a seed, and what each of them runs without a fault."""

    def __init__(self, run, switched, alone, seed, count, seconds):
        """Runs every problem without a fault, alone, so that it is known to which changed lines each of them comes."""
        self.run, self.switched, self.alone, self.seed, self.limit = run, switched, alone, str(seed), str(seconds)
        self.program = switched.built(run)
        self.reached, self.errors, self.cost = {}, {}, {}
        # What was found with this program before holds.
        kept = self.program.with_name("mill.json")
        before = hashlib.sha256(self.program.read_bytes()).hexdigest() + f" {seed}"
        found = json.loads(kept.read_text()) if kept.is_file() else {}
        found = found["problems"] if found.get("program") == before else {}
        # Faults that a problem caught, of those that it ran with: the best come first.
        self.caught, self.tried = [0] * count, [0] * count
        for problem in range(count):
            if str(problem) not in found:
                status, output, _ = run([str(self.program), self.seed, self.limit, str(problem)], 900)
                said = told(output).get(problem)
                if status != 0 or not said:
                    raise ValueError(f"problem {problem} without a fault: {output.strip().splitlines()[-1:]}")
                found[str(problem)] = [*said, sorted({int(word) for word in re.findall(r"^reached (\d+)$", output, re.M)})]
                kept.write_text(json.dumps({"program": before, "problems": found}))
            self.errors[problem], self.cost[problem], reached = said = found[str(problem)]
            self.reached[problem] = set(reached)
            print(f"  problem {problem:<3} {said[1]:>6.1f} s, {len(self.reached[problem])} changed lines reached", flush=True)

    def reaching(self, number):
        """Problems that come to the line of a fault."""
        return [problem for problem, reached in self.reached.items() if number in reached]

    def judged(self, name, patch):
        """The same of a fault by name; what fits no switch and is reached is built by itself."""
        number, switched = self.switched.numbers[name], self.switched
        if name not in switched.left or (name in switched.marked and not self.reaching(number)):
            return self.judge(number)
        return self.judge(None, switched.built(self.run, self.alone(patch)))

    def judge(self, number, program=None):
        """True where a fault is caught, and by which problem; or the cause for which none catches it. With a program of its own
        every problem is run."""
        problems = list(self.reached) if program else self.reaching(number)
        if not problems:
            return False, "not reached by any problem"
        problems.sort(key=lambda k: -(self.caught[k] + 0.5) / (self.tried[k] + 1.0) / (self.cost[k] + 0.2))
        command = [str(program or self.program), self.seed, self.limit, *map(str, problems)]
        status, output, _ = self.run(command, 900, fault=number)
        said = output.strip().splitlines()
        found = told(output)
        for problem in found:
            self.tried[problem] += 1
        if status != 0:
            miss = re.match(r"MISS: problem (\d+)", said[-1] if said else "")
            if miss:
                self.caught[int(miss[1])] += 1
                return True, said[-1].removeprefix("MISS: ").split("; ")[0]
            return True, "time limit" if status is None else next((line for line in said if "panicked" in line), f"ended with {status}")
        # Bits, or how far errors move, beside the problems that were never judged in the time.
        moved = {problem: change(self.errors[problem], errors) for problem, (errors, _) in found.items()}
        rest = f", {len(problems) - len(found)} of {len(problems)} not run in time" if len(found) < len(problems) else ""
        most = max(moved, key=moved.get, default=None)
        if most is None or moved[most] == 0.0:
            return False, f"no bit of an error moves in {len(found)} problems{rest}"
        share = f"{moved[most]:.1%}" if moved[most] < 1e300 else "another draw"
        count = sum(value > 0.0 for value in moved.values())
        return False, f"an error moves by {share} at most (problem {most}), in {count} of {len(found)} problems{rest}"


def told(output):
    """What the program says of each problem: draw and errors, and the seconds that it took."""
    lines = re.findall(r"^problem (\d+): (.*), ([0-9.]+) s$", output, re.M)
    return {int(number): (text, float(seconds)) for number, text, seconds in lines}


def change(before, after):
    """Largest change of an error of a problem, over the error; without end where another problem was drawn."""
    if before == after:
        return 0.0
    a, b = (re.match(r"(.*); errors ([-0-9.e ]+);", text) for text in (before, after))
    if not a or not b or a[1] != b[1]:
        return float("inf")
    pairs = zip(map(float, a[2].split()), map(float, b[2].split()))
    return max(abs(y - x) / x for x, y in pairs)
