#!/usr/bin/env python3
"""Opens a report in headless Chromium, at the width of a phone and of a desk, light and dark.

    scripts/check-report.py target/proctor/report.html [--png FOLDER]

Fails if the browser writes anything to its console, if the page asks for the network, if a figure is empty or has no
title or that of another, if the answers of the first screen are not on it, if the page with all of it unfolded is wider than
its window or a number of a table is cut, if a case that holds is open or a link does not open it, if something stays folded
on paper, or if the points of a chart cannot be reached by keyboard. With --png screenshots and the printed page are kept, to
be looked at. Needs Python 3 and a Chromium or Chrome; exit code 3 if there is none.
"""

import argparse
import concurrent.futures
import html
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

WIDTHS = [400, 1400]
# Height of a first screen, a phone's and a desk's: all answers end above it.
SCREENS = {400: 850, 1400: 1000}
NAMES = ["chromium", "chromium-browser", "google-chrome", "chrome"]
FLAGS = [
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--hide-scrollbars",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--allow-file-access-from-files", "--enable-logging=stderr", "--virtual-time-budget=4000",
]

# Loads the report in a frame of the width that is asked for, looks around in it, and writes down what it saw.
HARNESS = """<!DOCTYPE html><html><body style="margin:0">
<iframe id="frame" src="%(report)s" style="border:0;width:%(width)dpx;height:2000px"></iframe>
<script>
const seen = { errors: [] };
const frame = document.getElementById("frame");
frame.onload = () => {
  const page = frame.contentDocument;
  const root = page.documentElement;
  seen.width = root.scrollWidth;
  seen.title = page.title;
  seen.verdict = page.querySelector(".verdict strong")?.textContent ?? "";
  const bottom = (selector) => page.querySelector(selector)?.getBoundingClientRect().bottom ?? 0;
  seen.answers_end = bottom(".answers");
  seen.answers = page.querySelectorAll(".answers > div").length;
  seen.open = [...page.querySelectorAll("details.case[open]:not(.failed)")].map((part) => part.id);
  const first = page.querySelector("details.case:not([open])");
  if (first) {
    page.querySelector(`a[href='#${first.id}']`)?.click();
    frame.contentWindow.location.hash = first.id;
    frame.contentWindow.dispatchEvent(new Event("hashchange"));
    seen.opens = first.open;
  }
  frame.contentWindow.dispatchEvent(new Event("beforeprint"));
  seen.folded = page.querySelectorAll("details:not(.numbers):not([open])").length;
  page.querySelectorAll("details").forEach((part) => { part.open = true; });
  seen.unfolded = root.scrollWidth;
  seen.cut = [...page.querySelectorAll(".scroll td, .scroll th, .map td")]
    .filter((cell) => cell.getBoundingClientRect().right > root.clientWidth + 1 && cell.getBoundingClientRect().width > 0
      && getComputedStyle(cell.closest("thead") ?? cell).position !== "absolute")
    .map((cell) => cell.textContent).slice(0, 5);
  seen.sections = [...page.querySelectorAll("section h2")].map((h) => h.id);
  seen.requests = frame.contentWindow.performance.getEntriesByType("resource").map((r) => r.name);
  seen.links = [...page.querySelectorAll("a[href^='#']")].map((a) => a.getAttribute("href").slice(1))
    .filter((id) => !page.getElementById(id));
  seen.figures = [...page.querySelectorAll("figure")].map((figure) => {
    const svg = figure.querySelector("svg");
    const box = svg?.getBoundingClientRect();
    const font = [...(svg?.querySelectorAll("text") ?? [])]
      .map((t) => parseFloat(frame.contentWindow.getComputedStyle(t).fontSize) * box.width / svg.viewBox.baseVal.width);
    return {
      caption: figure.querySelector("figcaption")?.textContent ?? "",
      title: svg?.querySelector(":scope > title")?.textContent ?? "",
      width: box?.width ?? 0, height: box?.height ?? 0,
      points: svg?.querySelectorAll(".point").length ?? 0,
      curves: svg?.querySelectorAll("path.line:not([stroke-dasharray='5 3'])").length ?? 0,
      table: !!figure.querySelector("table"),
      smallest_text: font.length ? Math.min(...font) : null,
    };
  });
  const point = page.querySelector("figure svg .point[tabindex='0']");
  if (point) {
    point.focus();
    const tip = page.getElementById("tip");
    seen.tip = tip && !tip.hidden ? tip.textContent : "";
  }
  const out = document.createElement("pre");
  out.id = "seen";
  out.textContent = JSON.stringify(seen);
  document.body.replaceChildren(out);
};
</script></body></html>"""


def browser():
    for name in NAMES:
        path = shutil.which(name)
        if path:
            return path
    print("left out: no Chromium or Chrome found", file=sys.stderr)
    sys.exit(3)


def chromium(path, profile, *arguments):
    command = [path, *FLAGS, f"--user-data-dir={profile}", *arguments]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    console = [line for line in done.stderr.splitlines() if "CONSOLE" in line]
    return done.stdout, console


def look(path, report, width, folder):
    """What the browser saw at a width, and what is wrong with it."""
    harness = pathlib.Path(folder) / f"harness{width}.html"
    harness.write_text(HARNESS % {"report": report.as_uri(), "width": width})
    dom, console = chromium(path, f"{folder}/{width}", "--dump-dom", f"--window-size={max(width, 800)},2200", harness.as_uri())
    found = re.search(r'<pre id="seen">(.*?)</pre>', dom, re.S)
    if not found:
        return {}, ["the page did not load"]
    seen = json.loads(html.unescape(found.group(1)))
    faults = [f"console: {line}" for line in console]
    faults += [f"asks for {name}" for name in seen["requests"]]
    faults += [f"a link to #{name} leads nowhere" for name in seen["links"]]
    if seen["width"] > width:
        faults.append(f"the page is {seen['width']} wide in a window of {width}")
    if not seen["verdict"]:
        faults.append("no verdict")
    if not seen["figures"]:
        faults.append("no figures")
    if seen["answers"] < 2 or not 0 < seen["answers_end"] <= SCREENS[width]:
        faults.append(f"{seen['answers']} answers that end at {seen['answers_end']:.0f}, not on the first screen")
    faults += [f"{name} holds and is open" for name in seen["open"]]
    if seen.get("opens") is False:
        faults.append("a link to a case does not open it")
    if seen["folded"]:
        faults.append(f"{seen['folded']} parts stay folded on paper")
    if seen["unfolded"] > width:
        faults.append(f"unfolded, the page is {seen['unfolded']} wide in a window of {width}")
    faults += [f"cut: {text}" for text in seen["cut"]]
    titles = [figure["title"] for figure in seen["figures"]]
    faults += [f"two figures are called {title}" for title in sorted(set(titles)) if titles.count(title) > 1]
    for figure in seen["figures"]:
        name = figure["title"] or figure["caption"] or "a figure without a name"
        if not figure["title"] or not figure["caption"]:
            faults.append(f"{name}: no title or no caption")
        if figure["width"] < 100 or figure["height"] < 60:
            faults.append(f"{name}: {figure['width']} x {figure['height']} pixels")
        if not figure["points"] and not figure["curves"]:
            faults.append(f"{name}: no points and no curve")
        if not figure["table"]:
            faults.append(f"{name}: no table beside it")
        if figure["smallest_text"] and figure["smallest_text"] < 8:
            faults.append(f"{name}: text of {figure['smallest_text']:.1f} pixels")
    if seen["figures"] and not seen.get("tip"):
        faults.append("a point in focus does not show its values")
    return seen, faults


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("report", type=pathlib.Path)
    arguments.add_argument("--png", type=pathlib.Path, help="folder for screenshots")
    given = arguments.parse_args()
    if not given.report.is_file():
        print(f"{given.report}: no such file", file=sys.stderr)
        return 2
    report = given.report.resolve()
    text = report.read_text()
    bad = 0
    for address in re.findall(r'(?:src|href)="(https?:[^"]*)"', text):
        print(f"FAIL  the page asks for {address}")
        bad += 1
    path = browser()
    with tempfile.TemporaryDirectory() as folder:
        # A browser for each width, side by side: most of the time goes into laying out the page.
        with concurrent.futures.ThreadPoolExecutor() as looks:
            found = list(looks.map(lambda width: look(path, report, width, folder), WIDTHS))
        for width, (seen, faults) in zip(WIDTHS, found):
            bad += len(faults)
            for fault in faults:
                print(f"FAIL  at {width}: {fault}")
            if not faults:
                points = sum(figure["points"] for figure in seen["figures"])
                print(
                    f"PASS  at {width}: {seen['verdict']}; sections {', '.join(seen['sections'])}; "
                    f"{len(seen['figures'])} figures with {points} points"
                )
        if given.png:
            given.png.mkdir(parents=True, exist_ok=True)
            for width in WIDTHS:
                for scheme, extra in [("light", []), ("dark", ["--force-dark-mode", "--blink-settings=preferredColorScheme=0"])]:
                    picture = given.png / f"report-{width}-{scheme}.png"
                    chromium(path, f"{folder}/png", *extra, f"--window-size={width},{12000 if width < 800 else 6000}",
                             f"--screenshot={picture.resolve()}", report.as_uri())
                    print(f"      {picture}")
            paper = given.png / "report.pdf"
            chromium(path, f"{folder}/png", "--no-pdf-header-footer", f"--print-to-pdf={paper.resolve()}", report.as_uri())
            print(f"      {paper}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
