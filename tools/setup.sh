#!/usr/bin/env bash
# Creates .venv at the repository's root with what the tools need.
set -euo pipefail
cd "$(dirname "$0")/.."
python3 -m venv .venv
.venv/bin/pip install --quiet --disable-pip-version-check -r tools/requirements.txt
