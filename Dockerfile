# insonify in a container: the packages that ./dev package makes, on a bare Debian 12.
#
#     docker build -t insonify .
#     docker run --rm -v "$PWD:/work" insonify run /usr/share/insonify/scenes/sphere.yaml -o out
#
# Not built by the project's own tests, which have no Docker: its two commands, ./dev package and apt-get, are tried there.
FROM debian:12 AS build
RUN apt-get update && apt-get install -y --no-install-recommends ca-certificates git
COPY . /source
WORKDIR /source
RUN ./dev package

FROM debian:12
COPY --from=build /source/build/release/packages/*.deb /packages/
RUN apt-get update && apt-get install -y --no-install-recommends /packages/*.deb && rm -rf /packages /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["insonify"]
