#!/usr/bin/env bash
# report_check.sh PAGE [FOLDER]: opens a page of `wedge report` in headless Chromium (Debian package chromium), wide and as wide as
# a phone, and fails unless it loads without a message on the console, every image is drawn, every link within the page
# leads somewhere and nothing is wider than the window. Puts screenshots and a print as PDF into FOLDER.
set -euo pipefail
[ $# -ge 1 ] || { echo "usage: bash tests/apps/report_check.sh PAGE [FOLDER]" >&2; exit 2; }
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
  { echo "error: no Chromium: apt-get install chromium" >&2; exit 4; }
page=$(realpath "$1")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
folder=${2:-$scratch}
mkdir -p "$folder"

# The page with a probe, which shows the page to itself in a frame (a window is never narrower than 500 pixels) and writes what it finds.
probed() {
  cat "$page"
  echo "<script>const width = $1;"
  cat <<'PROBE'
addEventListener("load", () => {
  const text = document.documentElement.outerHTML.replace(/<script>const width[^]*$/, "");
  const frame = document.createElement("iframe");
  frame.style = "width: " + width + "px; height: 900px; border: 0";
  frame.addEventListener("load", () => {
    const page = frame.contentDocument, images = [...page.images], said = [];
    for (const image of images) if (!image.complete || image.naturalWidth === 0) said.push("not drawn: " + image.alt);
    for (const image of images) if (!image.alt) said.push("an image without words");
    for (const link of page.querySelectorAll("a[href^='#']"))
      if (!page.getElementById(link.hash.slice(1))) said.push("leads nowhere: " + link.hash);
    const ids = [...page.querySelectorAll("[id]")].map(e => e.id);
    if (new Set(ids).size !== ids.length) said.push("an id occurs twice");
    const wide = page.documentElement.scrollWidth, room = frame.contentWindow.innerWidth;
    if (room !== width || wide > room) said.push("wider than the window: " + wide + " in " + room);
    const result = document.createElement("p");
    result.textContent = "PROBE " + images.length + " images, height " + page.documentElement.scrollHeight + "; "
      + (said.join("; ") || "sound") + " END";
    document.body.replaceChildren(result);
  });
  frame.srcdoc = text;
  document.body.append(frame);
});
</script>
PROBE
}

look() { "$browser" --headless=new --no-sandbox --disable-gpu --hide-scrollbars --user-data-dir="$scratch/profile" "$@" 2>>"$scratch/log"; }

failed=0
for width in 1280 390; do
  : >"$scratch/log"
  probed $width >"$scratch/probed.html"
  look --enable-logging=stderr --window-size=$width,900 --virtual-time-budget=20000 --dump-dom "file://$scratch/probed.html" >"$scratch/dom"
  result=$(grep -o 'PROBE [0-9].* END' "$scratch/dom" | tail -n 1 || true)
  echo "$width px: ${result:-no answer}"
  case $result in *"; sound END") ;; *) failed=1 ;; esac
  if grep -F CONSOLE "$scratch/log"; then failed=1; fi
  height=$(echo "$result" | sed -n 's/.*height \([0-9]*\).*/\1/p')
  # Chromium draws at most 16384 pixels of height.
  look --window-size=$width,$((${height:-900} < 16000 ? ${height:-900} : 16000)) --screenshot="$folder/report_$width.png" "file://$page"
done
look --no-pdf-header-footer --print-to-pdf="$folder/report.pdf" "file://$page"
[ -s "$folder/report.pdf" ] || { echo "no PDF"; failed=1; }
[ $failed -eq 0 ] && echo "sound"
exit $failed
