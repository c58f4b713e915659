# SPDX-License-Identifier: BSD-3-Clause
# The suite on a bare Debian 12, built and ready:
#   docker build -t urban_nav . && docker run --rm -v "$PWD/data:/data" urban_nav map /data/YOUR.bag --out /data/out
FROM debian:12
COPY packages.apt /tmp/packages.apt
RUN apt-get update \
 && sed 's/#.*//' /tmp/packages.apt | xargs env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
 && rm -rf /var/lib/apt/lists/* /tmp/packages.apt
COPY . /opt/urban_nav
RUN /opt/urban_nav/urban_nav --help
WORKDIR /data
ENTRYPOINT ["/opt/urban_nav/urban_nav"]
