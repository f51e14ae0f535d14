// Nothing here is needed to read the page: it chooses a system, opens what a link leads into, and opens everything for the printer.
(() => {
  const select = document.getElementById("system");
  const choose = () => {
    for (const panel of document.querySelectorAll(".choice")) panel.classList.toggle("chosen", panel.id === select.value);
  };
  if (select) { select.addEventListener("change", choose); choose(); }
  const reveal = () => {
    const place = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (!place) return;
    for (let at = place; at; at = at.parentElement) if (at.tagName === "DETAILS") at.open = true;
    if (place.classList.contains("choice")) { select.value = place.id; choose(); }
    place.scrollIntoView();
  };
  addEventListener("hashchange", reveal);
  reveal();
  let closed = [];
  addEventListener("beforeprint", () => {
    closed = [...document.querySelectorAll("details:not([open]):not(.screen)")];
    for (const one of closed) one.open = true;
  });
  addEventListener("afterprint", () => { for (const one of closed) one.open = false; });
})();
