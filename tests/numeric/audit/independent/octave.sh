#!/bin/sh
# sh octave.sh: the implementation of octave.m as a program that speaks the audit's protocol of JSON lines.
exec octave-cli --quiet --norc "$(dirname "$0")/octave.m"
