#!/usr/bin/env bash
# Fetches the headers of one MeshLab version (its own and vcglib's) from the source that Debian publishes: no MeshLab
# has a development package. Needs dpkg and apt, but not root: it keeps apt's state in a folder of its own.
#
#   fetch_headers.sh VERSION DIR      VERSION is 2020.09, 2022.02 or 2025.07; DIR gets src/ and vcglib/
#
# Exit code 3: Debian no longer has that version (only its releases stay; 2025.07 is from its testing suite).
set -euo pipefail

version=$1 out=$2
case $version in
    2020.09) suite=bookworm sum=d6715352ff65caffdec0292858d4263eb0c3cbbf3b1e5c2e2bab218e3f234630 ;;
    2022.02) suite=trixie sum=11da26ec46c3fbbbc806d410a3221542ec21ec13fdcc55d624304600029435fd ;;
    2025.07) suite=forky sum=d22c98d362f2a284e481af8dbfc272b2222f5b9c67b3cf8bec57d1c3161886f4 ;;
    *) echo "fetch_headers.sh: no headers known for MeshLab $version" >&2 && exit 2 ;;
esac
if [[ -f $out/sha256 && $(<"$out/sha256") == "$sum" ]]; then
    exit
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work"/{lists/partial,cache/archives/partial,source}
touch "$work/status"
key=/usr/share/keyrings/debian-archive-keyring.gpg
echo "deb-src [signed-by=$key] ${DEBIAN_MIRROR:-http://deb.debian.org/debian} $suite main" >"$work/sources.list"
options=(
    -o Dir::State::lists="$work/lists" -o Dir::State::status="$work/status" -o Dir::Cache="$work/cache"
    -o Dir::Etc::SourceList="$work/sources.list" -o Dir::Etc::SourceParts=- -o APT::Sandbox::User=
    -o APT::Update::Post-Invoke-Success::= -o Acquire::Check-Valid-Until=false
)
# Only the tar ball: what else belongs to a source package goes away when the next one comes.
get() {
    cd "$work/source"
    apt-get -qq "${options[@]}" update &&
        apt-get -qq "${options[@]}" source --only-source --tar-only --download-only meshlab
}
if ! (get) || ! ls "$work"/source/meshlab_*.orig.tar.* >/dev/null 2>&1; then
    echo "fetch_headers.sh: Debian $suite does not have the source of MeshLab" >&2
    exit 3
fi
tarball=("$work"/source/meshlab_*.orig.tar.*)
if ! echo "$sum  ${tarball[0]}" | sha256sum --quiet --check >&2; then
    echo "fetch_headers.sh: $(basename "${tarball[0]}") of Debian $suite is not the source of MeshLab $version" >&2
    exit 3
fi

mkdir "$work/tree"
tar -xf "${tarball[0]}" -C "$work/tree" --strip-components=1 --wildcards --no-anchored '*.h' '*.hpp' '*/vcglib/vcg/*' \
    '*/vcglib/wrap/*' '*/src/common/*'
vcglib=$work/tree/vcglib
[[ -d $vcglib ]] || vcglib=$work/tree/src/vcglib
rm -rf "$out"
mkdir -p "$out/src" "$out/vcglib"
cp -r "$work/tree/src/common" "$out/src/"
cp -r "$vcglib/vcg" "$vcglib/wrap" "$out/vcglib/"
echo "$sum" >"$out/sha256"
