// main.cpp -- the command line.

#include <cstdio>

#include "insonify/version.h"

int main() { std::printf("insonify %s\n", insonify::kVersion); }
