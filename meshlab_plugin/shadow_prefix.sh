#!/usr/bin/env bash
# MeshLab 2020.09 loads plugins from its own folder only. This makes a second MeshLab out of links to the first, with
# the plugin beside the others, so that nothing needs root.
#
#   shadow_prefix.sh PLUGIN.so DIR      then start DIR/bin/meshlab
set -euo pipefail

plugin=$1 prefix=$2
lib=lib/$(uname -m)-linux-gnu/meshlab
if [[ ! -x /usr/bin/meshlab || ! -d /usr/$lib/plugins ]]; then
    echo "shadow_prefix.sh: MeshLab 2020.09 of Debian is not installed: apt-get install meshlab" >&2
    exit 1
fi
mkdir -p "$prefix/bin" "$prefix/$lib/plugins" "$prefix/share"
# Copies, as a program finds its folders from where it lies.
cp /usr/bin/meshlab /usr/bin/meshlabserver "$prefix/bin/"
ln -sfn "/usr/$lib/libmeshlab-common.so" "$prefix/$lib/libmeshlab-common.so"
ln -sfn /usr/share/meshlab "$prefix/share/meshlab"
ln -sf "/usr/$lib"/plugins/*.so "$prefix/$lib/plugins/"
rm -f "$prefix/$lib/plugins/libfilter_polycube.so"
cp "$plugin" "$prefix/$lib/plugins/libfilter_polycube.so"
