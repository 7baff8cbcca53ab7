#!/usr/bin/env bash
# with_flag.sh FLAG COMMAND…: a compiler launcher that puts FLAG behind all others, so that it wins.
flag=$1
shift
exec "$@" "$flag"
