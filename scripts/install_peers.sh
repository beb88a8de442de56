#!/usr/bin/env bash
# Installs the general engines of rigid bodies that bench/peers compares with, as Debian 12 packages them. Nothing else
# of the project needs them.
set -euo pipefail
exec "$(dirname -- "${BASH_SOURCE[0]}")/install_packages.sh" pkg-config \
    libbox2d-dev libchipmunk-dev libbullet-dev libmujoco-dev libode-dev
