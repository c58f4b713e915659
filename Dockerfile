# SPDX-License-Identifier: BSD-3-Clause
# The suite on a bare Debian 12, built and ready; it runs as the user `robot`:
#   docker build -t urban_nav .
#   docker run --rm --user "$(id -u):$(id -g)" -v "$PWD:/data" urban_nav map session.mcap --out out
FROM debian:12
COPY packages.apt /tmp/packages.apt
RUN apt-get update \
 && sed 's/#.*//' /tmp/packages.apt | xargs env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
 && rm -rf /var/lib/apt/lists/* /tmp/packages.apt
COPY . /opt/urban_nav
RUN /opt/urban_nav/urban_nav --help && useradd --create-home robot && install -d -o robot /data
ENV PYTHONPATH=/opt/urban_nav/build/ws/devel/lib/python3/dist-packages HOME=/home/robot
USER robot
WORKDIR /data
ENTRYPOINT ["/opt/urban_nav/urban_nav"]
CMD ["--help"]
