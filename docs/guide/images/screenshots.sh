#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-2-Clause
# Makes the pictures of a study's page in this folder:
#     docs/guide/images/screenshots.sh STUDY_FOLDER
# It needs chromium, ImageMagick's convert and cjpeg. Each page is shown in a frame of the wanted
# size, because windows of browsers have a smallest width. The print picture shows the page with its
# styles for print at the width of A4.
set -euo pipefail
images=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
page=$(realpath "$1")/report.html
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export HOME=$scratch

# shot NAME WIDTH HEIGHT PAGE [OPTIONS]
shot() {
  local name=$1 width=$2 height=$3 shown=$4
  shift 4
  printf '<!DOCTYPE html><body style="margin:0"><iframe src="file://%s" width="%s" height="%s" %s' \
    "$shown" "$width" "$height" 'style="border:0"></iframe>' >"$scratch/frame.html"
  chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --user-data-dir="$scratch/user" \
    --window-size="$width,$height" --screenshot="$scratch/$name.png" "$@" \
    "file://$scratch/frame.html" 2>"$scratch/log.txt" || { cat "$scratch/log.txt"; exit 1; }
  convert "$scratch/$name.png" ppm:- | cjpeg -quality 84 -optimize -outfile "$images/$name.jpg"
}

shot study-desktop 1280 800 "$page"
shot study-phone 390 844 "$page"
shot study-dark 1280 800 "$page" --blink-settings=preferredColorScheme=0
sed 's/@media print/@media all/' "$page" >"$scratch/print.html"
shot study-print 794 1123 "$scratch/print.html"
