#!/usr/bin/env bash
# Counts the lines of code of a commit: no blank lines and no lines that hold only a comment.
# Usage: count_lines.sh COMMIT PATTERN (an extended regular expression for paths)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
git ls-tree -r --name-only "$1" | grep -E "($2)" | grep -E '\.(h|cpp|inl|css|html|svg)$' |
  while read -r file; do git show "$1:$file"; done |
  grep -vcE '^[[:space:]]*(//.*)?$'
