// Values of points by mouse, touch and keyboard; links that open what is folded; everything open on paper. Without it the
// page loses the pictures of cases alone, whose numbers are in the record; what is folded opens by a click.
(() => {
  const tip = document.createElement("div");
  tip.id = "tip";
  tip.setAttribute("role", "status");
  tip.hidden = true;
  document.body.append(tip);
  const show = (point) => {
    const title = point.querySelector("title");
    if (!title) return;
    tip.textContent = title.textContent;
    tip.hidden = false;
    const at = point.getBoundingClientRect();
    const left = Math.min(at.right + 8, document.documentElement.clientWidth - tip.offsetWidth - 4);
    tip.style.left = `${Math.max(4, left) + scrollX}px`;
    tip.style.top = `${Math.max(4, at.top - tip.offsetHeight - 6) + scrollY}px`;
  };
  const hide = () => { tip.hidden = true; };
  const activate = (svg) => {
    const points = [...svg.querySelectorAll(".point")];
    // One stop of the tab key per picture; the arrow keys go from point to point.
    points.forEach((point, index) => point.setAttribute("tabindex", index ? "-1" : "0"));
    svg.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      const here = points.indexOf(document.activeElement);
      if (!step || here < 0) return;
      const next = points[here + step];
      if (next) { next.focus(); event.preventDefault(); }
    });
    for (const point of points) {
      point.addEventListener("pointerenter", () => show(point));
      point.addEventListener("pointerleave", hide);
      point.addEventListener("focus", () => show(point));
      point.addEventListener("blur", hide);
    }
  };
  document.querySelectorAll("figure svg").forEach(activate);
  // Deflate (RFC 1951) undone, bit by bit: a picture takes some milliseconds.
  const BASE = [3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 15, 17, 19, 23, 27, 31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258];
  const MORE = [0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0];
  const ORDER = [16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15];
  const inflate = (from) => {
    let at = 0, bit = 0, size = 0, out = new Uint8Array(8 * from.length + 64);
    const put = (byte) => {
      if (size === out.length) { const longer = new Uint8Array(2 * size); longer.set(out); out = longer; }
      out[size++] = byte;
    };
    const bits = (count) => {
      let value = 0;
      for (let i = 0; i < count; i++) {
        value |= ((from[at] >> bit) & 1) << i;
        if (++bit === 8) { bit = 0; at++; }
      }
      return value;
    };
    const code = (lengths) => {
      const count = new Array(16).fill(0), first = new Array(17).fill(0), symbols = [];
      lengths.forEach((length) => { if (length) count[length]++; });
      for (let i = 1; i < 16; i++) first[i + 1] = first[i] + count[i];
      lengths.forEach((length, symbol) => { if (length) symbols[first[length]++] = symbol; });
      return { count, symbols };
    };
    const next = ({ count, symbols }) => {
      let word = 0, first = 0, index = 0;
      for (let length = 1; length < 16; length++) {
        word |= bits(1);
        if (word - first < count[length]) return symbols[index + word - first];
        index += count[length];
        first = 2 * (first + count[length]);
        word *= 2;
      }
      throw new Error("not packed");
    };
    for (let last = 0; !last;) {
      last = bits(1);
      const kind = bits(2);
      if (kind === 0) {
        if (bit) { bit = 0; at++; }
        const length = from[at] | (from[at + 1] << 8);
        at += 4;
        for (let i = 0; i < length; i++) put(from[at++]);
        continue;
      }
      let letters, ways;
      if (kind === 1) {
        const fixed = (symbol) => (symbol < 144 ? 8 : symbol < 256 ? 9 : symbol < 280 ? 7 : 8);
        letters = code([...Array(288).keys()].map(fixed));
        ways = code(new Array(30).fill(5));
      } else {
        const sizes = [bits(5) + 257, bits(5) + 1, bits(4) + 4], lengths = new Array(19).fill(0), all = [];
        for (let i = 0; i < sizes[2]; i++) lengths[ORDER[i]] = bits(3);
        const short = code(lengths);
        while (all.length < sizes[0] + sizes[1]) {
          const symbol = next(short);
          if (symbol < 16) { all.push(symbol); continue; }
          const value = symbol === 16 ? all[all.length - 1] : 0;
          const times = symbol === 16 ? 3 + bits(2) : symbol === 17 ? 3 + bits(3) : 11 + bits(7);
          for (let i = 0; i < times; i++) all.push(value);
        }
        letters = code(all.slice(0, sizes[0]));
        ways = code(all.slice(sizes[0]));
      }
      for (let symbol = next(letters); symbol !== 256; symbol = next(letters)) {
        if (symbol < 256) { put(symbol); continue; }
        const length = BASE[symbol - 257] + bits(MORE[symbol - 257]);
        const way = next(ways), extra = way < 4 ? 0 : (way >> 1) - 1;
        const back = (way < 4 ? way : (2 + (way & 1)) << extra) + 1 + bits(extra);
        for (let i = 0; i < length; i++) put(out[size - back]);
      }
    }
    return new TextDecoder().decode(out.subarray(0, size));
  };
  // Pictures of a case are put in their place when it is opened.
  const unpack = (part) => {
    for (const box of part.querySelectorAll("[data-packed]")) {
      const bytes = Uint8Array.from(atob(box.dataset.packed), (letter) => letter.charCodeAt(0));
      delete box.dataset.packed;
      box.innerHTML = inflate(bytes);
      box.querySelectorAll("figure svg").forEach(activate);
    }
  };
  document.querySelectorAll("details.case").forEach((part) => {
    part.addEventListener("toggle", () => { if (part.open) unpack(part); });
    if (part.open) unpack(part);
  });
  document.addEventListener("keydown", (event) => { if (event.key === "Escape") hide(); });
  // A link to what is folded opens it.
  const unfold = () => {
    const at = location.hash && document.getElementById(location.hash.slice(1));
    if (!at) return;
    for (let part = at; part; part = part.parentElement) if (part.tagName === "DETAILS") { part.open = true; unpack(part); }
    at.scrollIntoView();
  };
  addEventListener("hashchange", unfold);
  unfold();
  // The same link clicked again changes nothing that could be heard of.
  document.addEventListener("click", (event) => {
    const link = event.target.closest?.("a[href^='#']");
    if (link && link.getAttribute("href") === location.hash) unfold();
  });
  // What is folded would be missing on paper; the numbers behind pictures, hundreds of pages, stay in the record.
  let opened = [];
  addEventListener("beforeprint", () => {
    unpack(document);
    opened = [...document.querySelectorAll("details:not(.numbers):not([open])")];
    opened.forEach((part) => { part.open = true; });
  });
  addEventListener("afterprint", () => opened.forEach((part) => { part.open = false; }));
})();
