// Values of points by mouse, touch and keyboard; links that open what is folded; everything open on paper. Without it the
// page loses nothing but this: every figure has a table, every point a title, and what is folded opens by a click.
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
  for (const svg of document.querySelectorAll("figure svg")) {
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
  }
  document.addEventListener("keydown", (event) => { if (event.key === "Escape") hide(); });
  // A link to what is folded opens it.
  const unfold = () => {
    const at = location.hash && document.getElementById(location.hash.slice(1));
    if (!at) return;
    for (let part = at; part; part = part.parentElement) if (part.tagName === "DETAILS") part.open = true;
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
    opened = [...document.querySelectorAll("details:not(.numbers):not([open])")];
    opened.forEach((part) => { part.open = true; });
  });
  addEventListener("afterprint", () => opened.forEach((part) => { part.open = false; }));
})();
