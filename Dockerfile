# insonify in a container: the packages that ./dev package makes, those of the bridges too, on a bare Debian 12.
#
#     docker build -t insonify .                      with the bridges to ROS 1, ROS 2 (DDS) and Gazebo
#     docker build -t insonify --target plain .       without: a fifth of the size
#     docker run --rm -v "$PWD:/work" insonify run sphere -o out
#
# Not built by the project's own tests, which have no Docker: its commands, ./dev bridges, ./dev package and apt-get, are tried there.
FROM debian:12 AS build
RUN apt-get update && apt-get install -y --no-install-recommends ca-certificates git
COPY . /source
WORKDIR /source
RUN ./dev bridges && ./dev package

FROM debian:12 AS plain
COPY --from=build /source/build/release/packages/*insonify_*.deb /source/build/release/packages/libinsonify0*.deb /packages/
RUN apt-get update && apt-get install -y --no-install-recommends /packages/*.deb && rm -rf /packages /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["insonify"]

FROM plain AS bridges
COPY --from=build /source/build/release/packages/insonify-*.deb /packages/
RUN apt-get update && apt-get install -y --no-install-recommends /packages/*.deb && rm -rf /packages /var/lib/apt/lists/*
